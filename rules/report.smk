# What readers see, and the review that a run must pass.
from recontrol.pipeline import standing

PAPERS = list(graph.papers)
VERDICTS = [f"results/{key}/verdicts.json" for key in PAPERS]


# A run whose verdicts or figure data are not the reviewed ones fails here, with both shown.
rule review:
    input:
        graph.references,
        "papers/{paper}/claims.yaml",
        verdicts="results/{paper}/verdicts.json",
        figures=lambda wildcards: graph.figures(wildcards.paper),
        code=graph.tools("recontrol.pipeline.review"),
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
        code=graph.tools("recontrol.pipeline.collect"),
    output:
        "results/verdicts.json",
    log:
        "run/log/collect.log",
    params:
        papers=PAPERS,
    message:
        "verdicts of all papers"
    shell:
        "python -m recontrol.pipeline collect {params.papers} > {log} 2>&1"


# The report: works from disk, without network and without JavaScript. It shows the large campaigns that exist; a
# parameter, no input, so that it never asks for one and still notices when one appears.
rule report:
    input:
        graph.read_by_report(),
        code=graph.tools("recontrol.report.__main__"),
        templates=[
            path.as_posix()
            for path in sorted(Path("src/recontrol/report").rglob("*.*"))
            if path.suffix != ".pyc"
        ],
    output:
        "results/report/index.html",
    log:
        "run/log/report.log",
    params:
        papers=PAPERS,
        campaigns=standing.large_campaigns(graph.campaigns()),
    message:
        "report: results/report/index.html"
    shell:
        "python -m recontrol.report build {params.papers} > {log} 2>&1"


# Show every difference from the review; exit code 1 if there is one.
rule check:
    input:
        [
            f"results/{key}/{name}.json"
            for key in PAPERS
            for name in ("verdicts", "model")
        ],
        [graph.figures(key) for key in PAPERS],
    log:
        "run/log/check.log",
    params:
        papers=PAPERS,
    message:
        "check against the review"
    shell:
        "python -m recontrol.pipeline review {params.papers} 2>&1 | tee {log}"


# One target a paper: `snakemake --cores 2 wan2014`.
for key in PAPERS:

    rule:
        name:
            key
        input:
            graph.everything(key),
            graph.exports(key),
            graph.ensembles([key]),
