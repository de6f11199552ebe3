# The chain of every paper under papers/: model, synthesis, certificates, simulation, figures, verdicts, report.
import os
import sys

sys.path[:0] = [os.path.join(workflow.basedir, "src")]

from snakemake.exceptions import WorkflowError

from recontrol import paper as paper_folders
from recontrol.errors import RecontrolError
from recontrol.pipeline import environment, guard
from recontrol.pipeline.closure import code_of, files_of

environment.pin()
os.environ["PATH"] = os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"]
os.environ["PYTHONPATH"] = os.path.join(workflow.basedir, "src") + os.pathsep + os.path.abspath(".")

try:
    PAPERS = {key: paper_folders.load(f"papers/{key}") for key in paper_folders.discover()}
    if workflow.is_main_process:
        guard.enter()
except RecontrolError as error:
    raise WorkflowError(str(error)) from None


configfile: "config/config.yaml"


wildcard_constraints:
    paper="|".join(PAPERS) or "none",


include: "rules/chain.smk"
include: "rules/report.smk"


# Everything of every paper, the report and the review.
rule all:
    default_target: True
    input:
        [every_artifact(key) for key in PAPERS],
        "results/report/index.html",


onerror:
    shell("python -m recontrol.pipeline salvage " + " ".join(PAPERS) + " >&2")
