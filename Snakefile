# The chain of every paper under papers/: model, synthesis, certificates, simulation, figures, verdicts, report.
import sys
from pathlib import Path

sys.path.insert(0, str(Path(workflow.basedir) / "src"))

from snakemake.exceptions import WorkflowError

from recontrol import paper as paper_folders
from recontrol.errors import RecontrolError
from recontrol.pipeline import closure, environment, guard
from recontrol.pipeline.graph import Graph

environment.for_jobs(Path(workflow.basedir))
try:
    graph = Graph(
        {key: paper_folders.load(f"papers/{key}") for key in paper_folders.discover()}
    )
    if workflow.is_main_process:
        guard.enter()
except RecontrolError as error:
    raise WorkflowError(str(error)) from None


configfile: "config/config.yaml"
configfile: "config/campaign.yaml"


report: "rules/captions/workflow.rst"


wildcard_constraints:
    paper="|".join(graph.papers) or "none",
    name=r"[^/]+",
    figure=r"[^/]+",


include: "rules/chain.smk"
include: "rules/report.smk"
include: "rules/artifacts.smk"
include: "rules/campaign.smk"


# Everything of every paper, the report and the review.
rule all:
    default_target: True
    input:
        [graph.everything(key) for key in graph.papers],
        [graph.exports(key) for key in graph.papers],
        [
            "results/report/index.html",
            "results/index.json",
            "results/crate/ro-crate-metadata.json",
        ],
        rules.latex.output,
        graph.ensembles(graph.papers),


onstart:
    closure.remember()
    guard.lift_rate_limit(workflow)


onsuccess:
    if Path("results/report/index.html").exists():
        print("recontrol: look at results/report/index.html", file=sys.stderr)


onerror:
    shell("python -m recontrol.pipeline salvage " + " ".join(graph.papers) + " >&2")
