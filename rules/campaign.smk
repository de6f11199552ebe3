# Robustness ensembles: seeded chunks, merged into distributions. `all` takes a few chunks, `campaign` all of them.
SMALL = (
    config["ensemble_chunks"],
    config["campaign_batch"],
    config["ensemble_chunks"],
)
LARGE = (
    config["campaign_chunks"],
    config["campaign_batch"],
    config["ensemble_chunks"],
)


# What the chunks of a paper depend on, in one file: Snakemake looks at every input of every job that could run, each time
# it chooses one, and hundreds of inputs of hundreds of jobs cost more than the jobs.
rule basis:
    input:
        COMMON,
        graph.before("campaign"),
        code=graph.code("campaign"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/ensemble-basis.json",
    log:
        "run/log/{paper}/ensemble-basis.log",
    message:
        "{wildcards.paper}: basis of the ensembles"
    shell:
        "python -m recontrol.pipeline campaign basis {wildcards.paper} > {log} 2>&1"


# Some chunks of one campaign: always the same members, whatever the size of the campaign and of its jobs.
rule chunks:
    input:
        "results/{paper}/ensemble-basis.json",
    output:
        "results/{paper}/ensemble/{name}/chunks-{first}-{last}.json",
    log:
        "run/log/{paper}/ensemble/{name}/chunks-{first}-{last}.log",
    wildcard_constraints:
        first=r"\d+",
        last=r"\d+",
    message:
        "{wildcards.paper}: {wildcards.name}, chunks {wildcards.first} to {wildcards.last}"
    shell:
        "python -m recontrol.pipeline campaign chunks {wildcards.paper} {wildcards.name}"
        " {wildcards.first} {wildcards.last} > {log} 2>&1"


# The distributions that every run shows.
rule ensemble:
    input:
        "results/{paper}/ensemble-basis.json",
        chunks=graph.chunks(*SMALL),
    output:
        multiext(
            "results/{paper}/ensemble/{name}", ".json", ".svg", ".pdf", ".png", ".csv"
        ),
    log:
        "run/log/{paper}/ensemble/{name}.log",
    params:
        sizes=SMALL,
    message:
        "{wildcards.paper}: {wildcards.name}, distributions"
    shell:
        "python -m recontrol.pipeline campaign merge {wildcards.paper} {wildcards.name} ensemble {params.sizes} > {log} 2>&1"


# The distributions of the large campaign.
rule merge:
    input:
        "results/{paper}/ensemble-basis.json",
        chunks=graph.chunks(*LARGE),
    output:
        multiext(
            "results/{paper}/campaign/{name}", ".json", ".svg", ".pdf", ".png", ".csv"
        ),
    log:
        "run/log/{paper}/campaign/{name}.log",
    params:
        sizes=LARGE,
    message:
        "{wildcards.paper}: {wildcards.name}, large campaign"
    shell:
        "python -m recontrol.pipeline campaign merge {wildcards.paper} {wildcards.name} campaign {params.sizes} > {log} 2>&1"


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
    from recontrol.pipeline.progress import watch

    watch(graph.campaigns(), LARGE)
