# What readers see, and the review that a run must pass.
import glob

VERDICTS = [f"results/{key}/verdicts.json" for key in PAPERS]


def references(wildcards):
    return sorted(glob.glob(f"papers/{wildcards.paper}/reference/*.csv"))


def tools(*modules):
    return files_of(frozenset(modules), Path(".").resolve())


# A run whose verdicts or figure data are not the reviewed ones fails here, with both shown.
rule review:
    input:
        references,
        "papers/{paper}/claims.yaml",
        verdicts="results/{paper}/verdicts.json",
        figures=lambda wildcards: figures_of(wildcards.paper),
        code=tools("recontrol.pipeline.review"),
    output:
        "results/{paper}/review.json",
    log:
        "run/log/{paper}/review.log",
    message:
        "{wildcards.paper}: review"
    shell:
        "python -m recontrol.pipeline review --stamp {wildcards.paper} > {log} 2>&1"


# The verdict tables of all papers in one file.
rule collect:
    input:
        VERDICTS,
        code=tools("recontrol.pipeline.collect"),
    output:
        "results/verdicts.json",
    log:
        "run/log/collect.log",
    message:
        "verdicts of all papers"
    params:
        papers=list(PAPERS),
    shell:
        "python -m recontrol.pipeline collect {params.papers} > {log} 2>&1"


# The report: works from disk, without network and without JavaScript.
rule report:
    input:
        "results/verdicts.json",
        [f"results/{key}/quantities.json" for key in PAPERS],
        [parts_of(key, stage) for key in PAPERS for stage in ("synthesis", "certificates")],
        [figures_of(key) for key in PAPERS],
        [multiext(f"papers/{key}/", "paper.yaml", "claims.yaml", "NOTES.md") for key in PAPERS],
        code=tools("recontrol.report"),
        templates=sorted(glob.glob("src/recontrol/report/**/*.*", recursive=True)),
    output:
        "results/report/index.html",
    log:
        "run/log/report.log",
    message:
        "report: results/report/index.html"
    params:
        papers=list(PAPERS),
    shell:
        "python -m recontrol.report build {params.papers} > {log} 2>&1"


# Show every difference from the review; exit code 1 if there is one.
rule check:
    input:
        [f"results/{key}/{name}.json" for key in PAPERS for name in ("verdicts", "model")],
        [figures_of(key) for key in PAPERS],
    params:
        papers=list(PAPERS),
    message:
        "check against the review"
    shell:
        "python -m recontrol.pipeline review {params.papers}"


# One target a paper: `snakemake --cores 2 wan2014`.
for key in PAPERS:

    rule:
        name:
            key
        input:
            every_artifact(key),
