"""Reproduction of published control papers, number by number."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def load(key: str, root: str = ".") -> Any:
    """Return what a finished run made of a paper, such as ``load("wan2014").controller`` (see `recontrol.results`)."""
    # By name: an import statement here would make every stage depend on the report's code.
    return import_module("recontrol.results").load(key, root)
