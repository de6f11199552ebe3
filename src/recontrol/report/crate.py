"""A Workflow Run RO-Crate of a finished run (results/crate): the workflow, what went in, and what came out.

Profiles: Process Run Crate 0.5, Workflow Run Crate 0.5, Workflow RO-Crate 1.0. Equal inputs give equal bytes: the only
date is the release date of CITATION.cff.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from recontrol.report import bibtex
from recontrol.report.collect import Paper, read_yaml

PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
TYPES = {
    ".json": "application/json", ".yaml": "application/yaml", ".md": "text/markdown", ".csv": "text/csv",
    ".svg": "image/svg+xml", ".pdf": "application/pdf", ".png": "image/png", ".lock": "text/plain",
    ".mat": "application/x-matlab-data", ".zip": "application/zip", ".tex": "text/x-tex", ".bib": "text/x-bibtex",
}  # fmt: skip
PARAMETERS = {
    "papers": ("input", "papers", "paper.yaml and claims.yaml of a paper: problem data and printed values as text"),
    "settings": ("input", "settings", "configuration and the locked environment"),
    "verdicts": ("output", "verdicts", "every printed value against what was found"),
    "numbers": ("output", "numbers", "models, gains, quantities and time series"),
    "proofs": ("output", "proofs", "certificates that stand alone"),
    "figures": ("output", "figures", "figures and the plotted data"),
}
"""Name -> direction, title, meaning of the workflow's formal parameters."""

RELEASED = "2026-01-01"


def build(root: Path, papers: list[str], target: Path) -> None:
    """Write the crate folder ``target`` anew from the artifacts of ``papers`` that exist."""
    from rocrate.rocrate import ROCrate

    shutil.rmtree(target, ignore_errors=True)
    crate = ROCrate(version="1.1")
    _describe(crate, Path(root), papers)
    workflow = crate.add_workflow(root / "Snakefile", "Snakefile", main=True, lang="snakemake", gen_cwl=False)
    _describe_workflow(crate, workflow)
    used = {name: _add_files(crate, root, name, paths) for name, paths in contents(root, papers).items()}
    _action(crate, workflow, used)
    crate.write(target)
    _order(target / "ro-crate-metadata.json")


def contents(root: Path, papers: list[str]) -> dict[str, list[Path]]:
    """Return the files of the crate, relative to the project, by formal parameter."""
    found: dict[str, list[Path]] = {name: [] for name in PARAMETERS}
    found["settings"] = [Path("config/config.yaml"), Path("environment.lock")]
    found["verdicts"] = [Path("results/verdicts.json"), Path("results/index.json")]
    for key in papers:
        folder, results = Path("papers", key), Path("results", key)
        found["papers"] += [folder / name for name in ("paper.yaml", "claims.yaml", "NOTES.md")]
        found["verdicts"].append(results / "verdicts.json")
        names = ("quantities.json", "model.json", "model.mat", "synthesis.mat", "series.zip")
        found["numbers"] += [results / name for name in names] + _below(root, results / "synthesis", "*.json")
        found["proofs"] += _below(root, results / "certificates", "*.json")
        for figure in Paper(root, key).figures:
            found["figures"] += [Path("figures", key, f"{figure['name']}.{suffix}") for suffix in ("svg", "csv")]
    return {name: [path for path in paths if (root / path).is_file()] for name, paths in found.items()}


def _below(root: Path, folder: Path, pattern: str) -> list[Path]:
    return [path.relative_to(root) for path in sorted((root / folder).glob(pattern))]


def _describe(crate: Any, root: Path, papers: list[str]) -> None:
    from rocrate.model.contextentity import ContextEntity

    citation = read_yaml(root / "CITATION.cff") or {}
    crate.name = f"A run of recontrol {bibtex.version()}: {', '.join(papers)}"
    crate.description = (
        "Published control papers rebuilt from their problem statements, and every printed value judged."
    )
    crate.datePublished = citation.get("date-released", RELEASED)
    crate.license = crate.add(
        ContextEntity(crate, "https://spdx.org/licenses/MIT", {"@type": "CreativeWork", "name": "MIT License"})
    )
    author = crate.add(
        ContextEntity(crate, "#contributors", {"@type": "Organization", "name": "The recontrol contributors"})
    )
    crate.root_dataset["author"] = crate.root_dataset["publisher"] = author
    crate.root_dataset["keywords"] = ", ".join(citation.get("keywords") or ["reproducibility", "control"])
    profiles = []
    for address, name in PROFILES.items():
        version = address.rsplit("/", 1)[1]
        entity = ContextEntity(crate, address, {"@type": "CreativeWork", "name": name, "version": version})
        profiles.append(crate.add(entity))
    crate.root_dataset["conformsTo"] = profiles


def _describe_workflow(crate: Any, workflow: Any) -> None:
    from rocrate.model.contextentity import ContextEntity

    workflow["name"] = "The chain of every paper: model, synthesis, certificates, simulation, figures, verdicts"
    workflow["version"] = bibtex.version()
    workflow["license"] = {"@id": "https://spdx.org/licenses/MIT"}
    made = {"input": [], "output": []}  # type: dict[str, list[Any]]
    for name, (direction, title, meaning) in PARAMETERS.items():
        properties = {
            "@type": "FormalParameter",
            "name": title,
            "description": meaning,
            "additionalType": "File",
            "conformsTo": {"@id": "https://bioschemas.org/profiles/FormalParameter/1.0-RELEASE"},
        }
        made[direction].append(crate.add(ContextEntity(crate, f"#{name}", properties)))
    workflow["input"], workflow["output"] = made["input"], made["output"]


def _add_files(crate: Any, root: Path, parameter: str, paths: list[Path]) -> list[Any]:
    added = []
    for path in paths:
        properties = {
            "name": path.as_posix(),
            "encodingFormat": TYPES.get(path.suffix, "application/octet-stream"),
            "exampleOfWork": {"@id": f"#{parameter}"},
        }
        added.append(crate.add_file(root / path, path.as_posix(), properties=properties))
    return added


def _action(crate: Any, workflow: Any, used: dict[str, list[Any]]) -> None:
    from rocrate.model.contextentity import ContextEntity

    sides: dict[str, list[Any]] = {"input": [], "output": []}
    for name, (direction, _, _) in PARAMETERS.items():
        sides[direction] += used[name]
    properties = {
        "@type": "CreateAction",
        "name": "snakemake all",
        "description": "One run of the whole chain on one machine.",
        "actionStatus": "http://schema.org/CompletedActionStatus",
    }
    action = crate.add(ContextEntity(crate, "#run", properties))
    action["instrument"] = workflow
    action["object"], action["result"] = sides["input"], sides["output"]
    action["agent"] = crate.root_dataset["author"]
    crate.root_dataset["mentions"] = action


def _order(path: Path) -> None:
    """Write the metadata with its entities in the order of their identifiers."""
    metadata = json.loads(path.read_text(encoding="utf-8"))
    metadata["@graph"].sort(key=lambda entity: (entity["@id"] not in ("ro-crate-metadata.json", "./"), entity["@id"]))
    path.write_text(json.dumps(metadata, indent=1, sort_keys=True, ensure_ascii=False) + "\n", encoding="utf-8")
