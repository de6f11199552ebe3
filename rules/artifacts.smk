# What others cite and read with their own tools: exports, the index of identities, LaTeX, the crate.


# Gains and models for MATLAB and as plain JSON, time series as CSV.
rule export:
    input:
        lambda wildcards: graph.numbers(wildcards.paper),
        code=graph.tools("recontrol.report.exports", "recontrol.report.__main__"),
    output:
        multiext("results/{paper}/model", ".mat", ".plain.json"),
        multiext("results/{paper}/synthesis", ".mat", ".plain.json"),
        "results/{paper}/series.zip",
    log:
        "run/log/{paper}/export.log",
    message:
        "exports of {wildcards.paper}"
    shell:
        "python -m recontrol.report export {wildcards.paper} > {log} 2>&1"


# Identity, unit, place, digests, stage and inputs of everything that was made.
rule index:
    input:
        graph.cited(),
        code=graph.tools("recontrol.report.artifacts", "recontrol.report.__main__"),
    output:
        "results/index.json",
    log:
        "run/log/index.log",
    params:
        papers=PAPERS,
    message:
        "index of identities and digests"
    shell:
        "python -m recontrol.report index {params.papers} > {log} 2>&1"


# Macros and tables for texts that cite findings.
rule latex:
    input:
        VERDICTS,
        [f"papers/{key}/{name}.yaml" for key in PAPERS for name in ("paper", "claims")],
        code=graph.tools("recontrol.report.latex", "recontrol.report.__main__"),
    output:
        [f"results/latex/{name}" for name in ("claims.tex", "counts.tex", "papers.bib")],
        [f"results/latex/{key}-claims.tex" for key in PAPERS],
    log:
        "run/log/latex.log",
    params:
        papers=PAPERS,
    message:
        "LaTeX macros and tables"
    shell:
        "python -m recontrol.report latex {params.papers} > {log} 2>&1"


# A Workflow Run RO-Crate of the run.
rule crate:
    input:
        graph.cited(),
        [graph.exports(key) for key in PAPERS],
        "results/verdicts.json",
        "results/index.json",
        [name for name in ("CITATION.cff",) if Path(name).exists()],
        code=graph.tools("recontrol.report.crate", "recontrol.report.__main__"),
    output:
        "results/crate/ro-crate-metadata.json",
    log:
        "run/log/crate.log",
    params:
        papers=PAPERS,
    message:
        "crate: results/crate"
    shell:
        "python -m recontrol.report crate {params.papers} > {log} 2>&1"
