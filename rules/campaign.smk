# Robustness ensembles: seeded chunks, merged into distributions. `all` takes a few chunks, `campaign` all of them.


# One chunk of one campaign: always the same members, whatever the size of the campaign.
rule chunk:
    input:
        COMMON,
        graph.before("campaign"),
        code=graph.code("campaign"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/ensemble/{name}/chunk-{chunk}.json",
    log:
        "run/log/{paper}/ensemble/{name}/chunk-{chunk}.log",
    benchmark:
        "run/benchmark/{paper}/ensemble/{name}/chunk-{chunk}.tsv"
    wildcard_constraints:
        chunk=r"\d{5}",
    message:
        "{wildcards.paper}: {wildcards.name}, chunk {wildcards.chunk}"
    shell:
        "python -m recontrol.pipeline campaign chunk {wildcards.paper} {wildcards.name} {wildcards.chunk} > {log} 2>&1"


# The distributions that every run shows.
rule ensemble:
    input:
        chunks=graph.chunks(config["ensemble_chunks"]),
        code=graph.code("campaign"),
    output:
        multiext(
            "results/{paper}/ensemble/{name}", ".json", ".svg", ".pdf", ".png", ".csv"
        ),
    log:
        "run/log/{paper}/ensemble/{name}.log",
    params:
        chunks=config["ensemble_chunks"],
    message:
        "{wildcards.paper}: {wildcards.name}, distributions"
    shell:
        "python -m recontrol.pipeline campaign merge {wildcards.paper} {wildcards.name} {params.chunks} ensemble > {log} 2>&1"


# The distributions of the large campaign.
rule merge:
    input:
        chunks=graph.chunks(config["campaign_chunks"]),
        code=graph.code("campaign"),
    output:
        multiext(
            "results/{paper}/campaign/{name}", ".json", ".svg", ".pdf", ".png", ".csv"
        ),
    log:
        "run/log/{paper}/campaign/{name}.log",
    params:
        chunks=config["campaign_chunks"],
    message:
        "{wildcards.paper}: {wildcards.name}, large campaign"
    shell:
        "python -m recontrol.pipeline campaign merge {wildcards.paper} {wildcards.name} {params.chunks} campaign > {log} 2>&1"


# All large campaigns: `snakemake --cores 2 campaign`; it resumes where it was stopped.
rule campaign:
    input:
        graph.ensembles(graph.papers, "campaign"),


# Say how far the campaign has come while it runs.
if (
    workflow.is_main_process
    and "campaign" in sys.argv
    and not guard.only_looking(sys.argv[1:])
):
    from recontrol.pipeline.campaign import watch

    watch(graph.campaigns(), config["campaign_chunks"])
