# One generic rule a stage. Each lists as `code` every file that its own and all earlier stages may import.


COMMON = ["config/config.yaml", "environment.lock"]


# Problem data -> arrays of the plant.
rule model:
    input:
        COMMON,
        code=graph.code("model"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/model.json",
    log:
        "run/log/{paper}/model.log",
    message:
        "{wildcards.paper}: model"
    shell:
        "python -m recontrol.pipeline stage model {wildcards.paper} > {log} 2>&1"


# Problem statement -> gains, one job a part.
rule synthesis:
    input:
        COMMON,
        graph.before("synthesis"),
        code=graph.code("synthesis"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/synthesis/{name}.json",
    log:
        "run/log/{paper}/synthesis/{name}.log",
    message:
        "{wildcards.paper}: synthesis {wildcards.name}"
    shell:
        "python -m recontrol.pipeline stage synthesis {wildcards.paper} {wildcards.name} > {log} 2>&1"


# Gains and printed values -> proofs that stand alone.
rule certificate:
    input:
        COMMON,
        graph.before("certificates"),
        code=graph.code("certificates"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/certificates/{name}.json",
    log:
        "run/log/{paper}/certificates/{name}.log",
    message:
        "{wildcards.paper}: certificate {wildcards.name}"
    shell:
        "python -m recontrol.pipeline stage certificates {wildcards.paper} {wildcards.name} > {log} 2>&1"


# Experiments -> quantities and time series.
rule simulation:
    input:
        COMMON,
        graph.before("simulation"),
        code=graph.code("simulation"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/simulation/{name}.json",
        "results/{paper}/simulation/{name}.npz",
    log:
        "run/log/{paper}/simulation/{name}.log",
    message:
        "{wildcards.paper}: simulation {wildcards.name}"
    shell:
        "python -m recontrol.pipeline stage simulation {wildcards.paper} {wildcards.name} > {log} 2>&1"


# Time series -> one figure in three formats, and the plotted data.
rule figure:
    input:
        COMMON,
        graph.before("figure"),
        code=graph.code("figure"),
        paper="papers/{paper}/paper.yaml",
    output:
        report(
            "figures/{paper}/{figure}.svg",
            caption="captions/figure.rst",
            category="{paper}",
            labels={"figure": "{figure}"},
        ),
        multiext("figures/{paper}/{figure}", ".pdf", ".png", ".csv"),
    log:
        "run/log/{paper}/figures/{figure}.log",
    params:
        title=lambda wildcards: graph.figure(wildcards).title,
        caption=lambda wildcards: graph.figure(wildcards).caption,
    message:
        "{wildcards.paper}: figure {wildcards.figure}"
    shell:
        "python -m recontrol.pipeline figure {wildcards.paper} {wildcards.figure} > {log} 2>&1"


# Every printed value against what was found.
rule verdicts:
    input:
        COMMON,
        graph.before("verdicts"),
        code=graph.code("verdicts"),
        folder=multiext("papers/{paper}/", "paper.yaml", "claims.yaml", "NOTES.md"),
    output:
        report(
            "results/{paper}/verdicts.json",
            caption="captions/verdicts.rst",
            category="{paper}",
            labels={"figure": "verdicts"},
        ),
    log:
        "run/log/{paper}/verdicts.log",
    message:
        "{wildcards.paper}: verdicts"
    shell:
        "python -m recontrol.pipeline verdicts {wildcards.paper} > {log} 2>&1"


# Every other number, by name.
rule quantities:
    input:
        COMMON,
        graph.before("quantities"),
        code=graph.code("quantities"),
        paper="papers/{paper}/paper.yaml",
    output:
        "results/{paper}/quantities.json",
    log:
        "run/log/{paper}/quantities.log",
    message:
        "{wildcards.paper}: quantities"
    shell:
        "python -m recontrol.pipeline quantities {wildcards.paper} > {log} 2>&1"
