# One generic rule a stage. Each lists as `code` every file that its own and all earlier stages may import.


def code(stage):
    return lambda wildcards: code_of(stage, wildcards.paper)


def parts_of(key, stage):
    """Artifacts of one stage of one paper."""
    parts = PAPERS[key].parts(stage)
    made = [f"results/{key}/{stage}/{part}.json" for part in parts]
    return made + [f"results/{key}/simulation/{part}.npz" for part in parts if stage == "simulation"]


def before(*stages):
    """Inputs of a stage: the artifacts of all earlier stages of the paper."""

    def artifacts(wildcards):
        found = [f"results/{wildcards.paper}/model.json"]
        for stage in stages:
            found += parts_of(wildcards.paper, stage)
        return found

    return artifacts


def figures_of(key):
    return [f"figures/{key}/{name}.{kind}" for name in PAPERS[key].file.figures for kind in ("svg", "pdf", "png", "csv")]


def every_artifact(key):
    """All artifacts of a paper, of every stage: deleting any of them makes the plain command rebuild it."""
    found = [f"results/{key}/{name}.json" for name in ("model", "verdicts", "quantities", "review")]
    for stage in ("synthesis", "certificates", "simulation"):
        found += parts_of(key, stage)
    return found + figures_of(key)


COMMON = ["config/config.yaml", "environment.lock"]


# Problem data -> arrays of the plant.
rule model:
    input:
        COMMON,
        code=code("model"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/model.json",
    log:
        "run/log/{paper}/model.log",
    benchmark:
        "run/benchmark/{paper}/model.tsv"
    message:
        "{wildcards.paper}: model"
    shell:
        "python -m recontrol.pipeline stage model {wildcards.paper} > {log} 2>&1"


# Problem statement -> gains, one job a part.
rule synthesis:
    input:
        COMMON,
        before(),
        code=code("synthesis"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/synthesis/{name}.json",
    log:
        "run/log/{paper}/synthesis/{name}.log",
    benchmark:
        "run/benchmark/{paper}/synthesis/{name}.tsv"
    message:
        "{wildcards.paper}: synthesis {wildcards.name}"
    shell:
        "python -m recontrol.pipeline stage synthesis {wildcards.paper} {wildcards.name} > {log} 2>&1"


# Gains and printed values -> proofs that stand alone.
rule certificate:
    input:
        COMMON,
        before("synthesis"),
        code=code("certificates"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/certificates/{name}.json",
    log:
        "run/log/{paper}/certificates/{name}.log",
    benchmark:
        "run/benchmark/{paper}/certificates/{name}.tsv"
    message:
        "{wildcards.paper}: certificate {wildcards.name}"
    shell:
        "python -m recontrol.pipeline stage certificates {wildcards.paper} {wildcards.name} > {log} 2>&1"


# Experiments -> quantities and time series.
rule simulation:
    input:
        COMMON,
        before("synthesis", "certificates"),
        code=code("simulation"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/simulation/{name}.json",
        "results/{paper}/simulation/{name}.npz",
    log:
        "run/log/{paper}/simulation/{name}.log",
    benchmark:
        "run/benchmark/{paper}/simulation/{name}.tsv"
    message:
        "{wildcards.paper}: simulation {wildcards.name}"
    shell:
        "python -m recontrol.pipeline stage simulation {wildcards.paper} {wildcards.name} > {log} 2>&1"


# Time series -> one figure in three formats, and the plotted data.
rule figure:
    input:
        COMMON,
        before("synthesis", "certificates", "simulation"),
        code=code("figure"),
        paper="papers/{paper}/paper.yaml",
    output:
        multiext("figures/{paper}/{figure}", ".svg", ".pdf", ".png", ".csv"),
    log:
        "run/log/{paper}/figures/{figure}.log",
    benchmark:
        "run/benchmark/{paper}/figures/{figure}.tsv"
    message:
        "{wildcards.paper}: figure {wildcards.figure}"
    shell:
        "python -m recontrol.pipeline figure {wildcards.paper} {wildcards.figure} > {log} 2>&1"


# Every printed value against what was found.
rule verdicts:
    input:
        COMMON,
        before("synthesis", "certificates", "simulation"),
        code=code("verdicts"),
        folder=multiext("papers/{paper}/", "paper.yaml", "claims.yaml", "NOTES.md"),
    output:
        "results/{paper}/verdicts.json",
    log:
        "run/log/{paper}/verdicts.log",
    benchmark:
        "run/benchmark/{paper}/verdicts.tsv"
    message:
        "{wildcards.paper}: verdicts"
    shell:
        "python -m recontrol.pipeline verdicts {wildcards.paper} > {log} 2>&1"


# Every other number, by name.
rule quantities:
    input:
        COMMON,
        before("synthesis", "certificates", "simulation"),
        code=code("quantities"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/quantities.json",
    log:
        "run/log/{paper}/quantities.log",
    benchmark:
        "run/benchmark/{paper}/quantities.tsv"
    message:
        "{wildcards.paper}: quantities"
    shell:
        "python -m recontrol.pipeline quantities {wildcards.paper} > {log} 2>&1"
