"""What a stage function receives: arguments bound by name, artifacts of earlier stages read when they are touched."""

from __future__ import annotations

import importlib
import inspect
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

from recontrol import paper as papers
from recontrol.errors import RecontrolError, StageError, UnknownNameError
from recontrol.pipeline import store
from recontrol.pipeline.closure import ORDER, home_of
from recontrol.pipeline.layout import artifact, series_file


class Parts(Mapping[str, Any]):
    """Artifacts of one stage by part name; each is read, and checked against its record, at first use."""

    def __init__(self, key: str, stage: str, parts: list[str]):
        self._key, self._stage, self._parts = key, stage, parts
        self._loaded: dict[str, Any] = {}

    def __getitem__(self, part: str) -> Any:
        if part not in self._parts:
            raise UnknownNameError(
                f"papers/{self._key}/paper.yaml: stage {self._stage} has no part {part!r}; "
                f"its parts: {', '.join(self._parts) or 'none'}"
            )
        if part not in self._loaded:
            self._loaded[part] = self._read(part)
        return self._loaded[part]

    def _read(self, part: str) -> Any:
        if self._stage == "certificates":
            return store.read_certificate(artifact(self._key, self._stage, part))
        values = store.read_json(artifact(self._key, self._stage, part))
        if self._stage != "simulation":
            return values
        return {"values": values, "series": read_series(series_file(self._key, part))}

    def __iter__(self) -> Iterator[str]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)


def read_series(path: Path) -> dict[str, Any]:
    """Arrays of an .npz artifact. Raises ArtifactError as store.read_bytes."""
    import io

    import numpy as np

    with np.load(io.BytesIO(store.read_bytes(path)), allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


class Inputs:
    """Everything a function of a paper folder may ask for by argument name."""

    def __init__(self, paper: papers.Paper, config: Mapping[str, Any], stages: tuple[str, ...]):
        self.paper, self.config = paper, config
        self._available: dict[str, Callable[[], Any]] = {"data": lambda: paper.data, "config": lambda: config}
        self._cache: dict[str, Any] = {}
        for stage in stages:
            self._available[stage] = self._loader(stage)

    def _loader(self, stage: str) -> Callable[[], Any]:
        if stage == "model":
            return lambda: store.read_json(artifact(self.paper.key, "model"))
        return lambda: Parts(self.paper.key, stage, self.paper.parts(stage))

    def bind(self, function: Callable[..., Any], **extra: Any) -> dict[str, Any]:
        """Keyword arguments for `function`. Raises StageError for an argument name that means nothing."""
        arguments = {}
        for name, parameter in inspect.signature(function).parameters.items():
            if name in extra:
                arguments[name] = extra[name]
            elif name in self._available:
                if name not in self._cache:
                    self._cache[name] = self._available[name]()
                arguments[name] = self._cache[name]
            elif parameter.default is inspect.Parameter.empty:
                raise StageError(
                    f"{where(function)}: argument {name!r} of {function.__name__} is unknown here; "
                    f"allowed: {', '.join([*self._available, *extra])}"
                )
        return arguments

    def call(self, function: Callable[..., Any], **extra: Any) -> Any:
        """Call a function with its arguments bound by name."""
        return function(**self.bind(function, **extra))


def before(stage: str) -> tuple[str, ...]:
    """Stages whose artifacts `stage` may read."""
    return ORDER[: ORDER.index(stage)] if stage in ORDER else ORDER


def earlier(paper: papers.Paper, stage: str) -> list[Path]:
    """Artifacts of all earlier stages."""
    paths = []
    for name in before(stage):
        if name == "model":
            paths.append(artifact(paper.key, name))
            continue
        paths += [artifact(paper.key, name, part) for part in paper.parts(name)]
        paths += [series_file(paper.key, part) for part in paper.parts(name) if name == "simulation"]
    return paths


def module_of(key: str, name: str) -> ModuleType:
    """Import papers.<key>.<name>. Raises StageError naming the file if that fails."""
    if "" not in sys.path and str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))
    module = f"papers.{key}.{name}"
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name and module.startswith(error.name):
            raise StageError(f"papers/{key}/{name}.py: missing; paper.yaml asks for functions of it") from None
        raise


def function_of(key: str, module: str, name: str) -> Callable[..., Any]:
    """The function `name` of a paper's module, or of a topic of that package (`topic.name` says of which).

    Raises StageError if there is none.
    """
    topic, _, function = name.rpartition(".")
    found_in = f"{module}.{topic}" if topic else home_of(key, module, function).removeprefix(f"papers.{key}.")
    home = module_of(key, found_in)
    found = getattr(home, function.replace("-", "_"), None)
    if not callable(found):
        raise StageError(f"{home.__name__.replace('.', '/')}: has no function {function.replace('-', '_')!r}")
    return found


def where(function: Callable[..., Any]) -> str:
    """`file:line` of a function, relative to the working directory where possible."""
    source = source_of(function)
    return f"{source['file']}:{source['line']}"


def source_of(function: Callable[..., Any], name: str | None = None) -> dict[str, Any]:
    """File (relative to the working directory) and line of a function; the line of `name = ...` if it was made so."""
    code = inspect.unwrap(function).__code__
    path, line = Path(code.co_filename), code.co_firstlineno
    if name and name != code.co_name:
        made = re.search(rf"^{re.escape(name)} = ", path.read_text(encoding="utf-8"), re.MULTILINE)
        line = made.string[: made.start()].count("\n") + 1 if made else line
    if path.is_relative_to(Path.cwd()):
        path = path.relative_to(Path.cwd())
    return {"file": path.as_posix(), "line": line}


def load_config(path: Path | str = "config/config.yaml") -> dict[str, Any]:
    """The run's configuration; numbers as numbers. Raises RecontrolError for a file that is not a mapping."""
    import yaml

    try:
        content = yaml.safe_load(Path(path).read_text())
    except (OSError, yaml.YAMLError) as error:
        raise RecontrolError(f"{path}: cannot be read: {' '.join(str(error).split())}") from None
    if not isinstance(content, dict):
        raise RecontrolError(f"{path}: expected a mapping of settings")
    return content
