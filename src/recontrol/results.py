"""A finished run in Python: `recontrol.load("wan2014")` gives claims, numbers, series and python-control systems."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

from recontrol.errors import MissingArtifactError, StageError, UnknownNameError
from recontrol.report import exports
from recontrol.report.claim import Claim
from recontrol.report.collect import Paper


class Results:
    """What a run made of one paper. Values are floats and arrays; `exact` gives rationals and balls."""

    def __init__(self, root: Path, key: str):
        self._paper = Paper(root, key)
        self.key = key

    def __repr__(self) -> str:
        return f"<recontrol results of {self.key}: {len(self.claims)} claims>"

    @cached_property
    def claims(self) -> dict[str, Claim]:
        """Claims by id: `.printed`, `.verdict`, `.strength`, `.findings`, ..."""
        return {claim.id: claim for claim in self._paper.claims}

    @cached_property
    def quantities(self) -> dict[str, Any]:
        """Name -> value, or name -> {case: value}."""
        from recontrol.pipeline import encode

        found: dict[str, Any] = {}
        for row in self._paper.quantities:
            value = exports.plain(encode.decode(row.get("value")))
            if row.get("case") is None:
                found[row["name"]] = value
            else:
                found.setdefault(row["name"], {})[row["case"]] = value
        return found

    @cached_property
    def exact(self) -> dict[str, Any]:
        """Model and synthesis as stored: {"model": ..., "synthesis": {part: ...}} with rationals and balls."""
        return {
            "model": exports.decoded(self._paper.results / "model.json"),
            "synthesis": exports.synthesis(self._paper),
        }

    @cached_property
    def model(self) -> dict[str, Any]:
        """The model artifact in floats."""
        return exports.plain(self.exact["model"])

    @cached_property
    def synthesis(self) -> dict[str, Any]:
        """The synthesis artifacts in floats, by part."""
        return exports.plain(self.exact["synthesis"])

    @cached_property
    def simulation(self) -> dict[str, dict[str, Any]]:
        """Part -> {"values": numbers, "series": arrays}."""
        import numpy as np

        found: dict[str, dict[str, Any]] = {}
        for path in sorted((self._paper.results / "simulation").glob("*.json")):
            arrays = path.with_suffix(".npz")
            series: dict[str, Any] = {}
            if arrays.is_file():
                with np.load(arrays, allow_pickle=False) as archive:
                    series = {name: archive[name] for name in archive.files}
            found[path.stem] = {"values": exports.plain(exports.decoded(path)), "series": series}
        return found

    @cached_property
    def figures(self) -> dict[str, Path]:
        """Figure name -> its SVG file."""
        folder = self._paper.root / "figures" / self.key
        return {figure["name"]: folder / f"{figure['name']}.svg" for figure in self._paper.figures if figure["files"]}

    @cached_property
    def systems(self) -> dict[str, Any]:
        """python-control state spaces: those that the paper folder names, and every A, B, C, D among the artifacts."""
        found = {f"model/{n}" if n else "model": s for n, s in state_spaces(self.model)}
        found |= {f"synthesis/{name}": system for name, system in state_spaces(self.synthesis)}
        return {**found, **self._named()}

    @property
    def plant(self) -> Any:
        """The paper's plant as a python-control system. Raises UnknownNameError if the folder names none."""
        return self._system("plant")

    @property
    def controller(self) -> Any:
        """The published controller as a python-control system. Raises UnknownNameError if the folder names none."""
        return self._system("controller")

    def _system(self, name: str) -> Any:
        if name not in self.systems:
            known = ", ".join(self.systems) or "none"
            raise UnknownNameError(f"papers/{self.key}/systems.py names no {name!r}; systems that there are: {known}")
        return self.systems[name]

    def _named(self) -> dict[str, Any]:
        """Systems of papers/<key>/systems.py, if any: `systems(data, model, synthesis)` -> name -> (A, B, C, D)."""
        import control
        import numpy as np

        from recontrol import paper as papers

        if not (self._paper.folder / "systems.py").is_file():
            return {}
        place = str(self._paper.root.resolve())
        if place not in sys.path:
            sys.path.insert(0, place)
        module = importlib.import_module(f"papers.{self.key}.systems")
        made = module.systems(papers.load(self._paper.folder).data, self.exact["model"], self.exact["synthesis"])
        if not isinstance(made, Mapping):
            raise StageError(f"papers/{self.key}/systems.py: systems returns a mapping name -> (A, B, C, D)")
        return {
            name: control.ss(*(np.atleast_2d(exports.plain(matrix)).astype(float) for matrix in matrices))
            for name, matrices in made.items()
        }


def state_spaces(tree: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """Return (place, python-control system) of every mapping with fitting matrices A, B, C and perhaps D."""
    import control
    import numpy as np

    if not isinstance(tree, Mapping):
        return
    given = [tree.get(name) for name in "ABC"]
    matrices = [M for M in given if isinstance(M, np.ndarray) and M.ndim == 2 and M.dtype.kind in "iuf"]
    if len(matrices) == len(given):
        (A, B, C), D = matrices, tree.get("D")
        D = D if isinstance(D, np.ndarray) else np.zeros((C.shape[0], B.shape[1]))
        n = A.shape[0]
        if A.shape == (n, n) and B.shape[0] == n and C.shape[1] == n and D.shape == (C.shape[0], B.shape[1]):
            yield place, control.ss(A, B, C, D)
    for name, item in tree.items():
        if not (name == "exact" and "A" in tree):
            yield from state_spaces(item, f"{place}/{name}" if place else str(name))


def load(key: str, root: Path | str = ".") -> Results:
    """Return the results of a paper. Raises UnknownNameError if unknown, MissingArtifactError before its run."""
    root = Path(root)
    if not (root / "papers" / key / "paper.yaml").is_file():
        raise UnknownNameError(f"no paper {key!r} under {(root / 'papers').resolve()}")
    if not (root / "results" / key / "model.json").is_file():
        raise MissingArtifactError(f"results/{key}: not made yet; run `snakemake --cores 2 {key}`")
    return Results(root, key)
