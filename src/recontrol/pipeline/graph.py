"""Which artifacts each rule of the chain reads: the functions that the rules call while the graph is built."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from recontrol.paper import STAGES_WITH_PARTS, Paper
from recontrol.pipeline.closure import ORDER, code_of, files_of
from recontrol.pipeline.layout import (
    FIGURE_FORMATS,
    artifact,
    chunk_ranges,
    chunks_file,
    distribution_file,
    figure_file,
    series_file,
)


class Graph:
    """Artifacts of a set of papers. `papers` maps keys to validated folders."""

    def __init__(self, papers: Mapping[str, Paper]):
        self.papers = papers

    def stage(self, key: str, stage: str) -> list[str]:
        """Artifacts of one stage of one paper."""
        if stage == "model":
            return [str(artifact(key, "model"))]
        parts = self.papers[key].parts(stage)
        series = [str(series_file(key, part)) for part in parts] if stage == "simulation" else []
        return [str(artifact(key, stage, part)) for part in parts] + series

    def before(self, stage: str) -> Callable[[Any], list[str]]:
        """Input function: artifacts of all stages before `stage` of the wildcard's paper."""
        earlier = ORDER[: ORDER.index(stage)] if stage in ORDER else ORDER
        return lambda wildcards: [name for step in earlier for name in self.stage(wildcards.paper, step)]

    def ensembles(self, keys: Iterable[str], target: str = "ensemble") -> list[str]:
        """Merged distributions of the campaigns of some papers, and their pictures."""
        names = [(key, name) for key in keys for name in self.papers[key].file.campaigns]
        return [str(distribution_file(*name, target, kind)) for name in names for kind in ("json", *FIGURE_FORMATS)]

    def campaigns(self) -> list[str]:
        """All campaigns as `paper/name`."""
        return [f"{key}/{name}" for key, paper in self.papers.items() for name in paper.file.campaigns]

    @staticmethod
    def chunks(count: int, batch: int, small: int) -> Callable[[Any], list[str]]:
        """Input function: the first `count` chunks of the wildcards' campaign, a file for each range of them."""
        ranges = chunk_ranges(count, batch, small)
        return lambda wildcards: [str(chunks_file(wildcards.paper, wildcards.name, *ends)) for ends in ranges]

    def figures(self, key: str) -> list[str]:
        """All files of all figures of a paper."""
        names = self.papers[key].file.figures
        return [str(figure_file(key, name, kind)) for name in names for kind in FIGURE_FORMATS]

    def figure(self, wildcards: Any) -> Any:
        """Title and caption of the wildcards' figure."""
        return self.papers[wildcards.paper].file.figures[wildcards.figure]

    def everything(self, key: str) -> list[str]:
        """All artifacts of a paper, of every stage: deleting any of them makes the plain command rebuild it."""
        found = [str(artifact(key, name)) for name in ("model", "verdicts", "quantities", "review")]
        return found + [name for stage in STAGES_WITH_PARTS for name in self.stage(key, stage)] + self.figures(key)

    def read_by_report(self) -> list[str]:
        """What the report reads of all papers."""
        found = ["results/verdicts.json"]
        for key in self.papers:
            found += [str(artifact(key, "verdicts")), str(artifact(key, "quantities"))]
            found += [name for stage in ("synthesis", "certificates") for name in self.stage(key, stage)]
            found += self.figures(key) + self.ensembles([key])
            found += [f"papers/{key}/{name}" for name in ("paper.yaml", "claims.yaml", "NOTES.md")]
        return found

    def numbers(self, key: str) -> list[str]:
        """Models, gains and time series of a paper."""
        return [name for stage in ("model", "synthesis", "simulation") for name in self.stage(key, stage)]

    def exports(self, key: str) -> list[str]:
        """What a paper exports for other tools."""
        names = ("model.mat", "model.plain.json", "synthesis.mat", "synthesis.plain.json", "series.zip")
        return [f"results/{key}/{name}" for name in names]

    def cited(self) -> list[str]:
        """Everything of all papers that has an identity, and where its titles and units stand."""
        found = []
        for key in self.papers:
            found += [str(artifact(key, name)) for name in ("verdicts", "quantities")]
            found += self.numbers(key) + self.stage(key, "certificates") + self.figures(key)
            found += [f"papers/{key}/{name}" for name in ("paper.yaml", "claims.yaml", "NOTES.md")]
        return found

    @staticmethod
    def code(stage: str) -> Callable[[Any], list[str]]:
        """Input function: every file that a stage and all earlier ones of the wildcards' paper may import."""
        return lambda wildcards: code_of(stage, wildcards.paper, figure=wildcards.get("figure"))

    @staticmethod
    def tools(*modules: str) -> list[str]:
        """Every file that some modules of this project load."""
        return files_of(frozenset(modules), Path.cwd())

    @staticmethod
    def references(wildcards: Any) -> list[str]:
        """Reference data of the wildcard's paper."""
        return sorted(path.as_posix() for path in Path("papers", wildcards.paper, "reference").glob("*.csv"))
