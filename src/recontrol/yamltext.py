"""YAML read as text: every scalar stays the string that was typed, and every key knows its line.

Tags, anchors, aliases, duplicate keys and several documents are refused, so that a file means what it shows.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from recontrol.errors import PaperError

LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""libyaml's parser where the package has it; it reads the same language ten times faster."""
MAX_DEPTH = 30
MAX_BYTES = 2_000_000


class Lines(dict[tuple[str | int, ...], int]):
    """Line number of each key path, for error messages."""

    def nearest(self, path: tuple[str | int, ...]) -> int:
        """Line of `path`, or of its closest known ancestor."""
        while path and path not in self:
            path = path[:-1]
        return self.get(path, 1)


def load(path: Path) -> tuple[Any, Lines]:
    """Parse a file into dicts, lists and strings, with the line of every key.

    Raises PaperError naming file and line for anything that is not plain, unambiguous text YAML.
    """
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise PaperError(f"{path}: cannot be read ({error.strerror}); every paper folder needs this file") from None
    if len(raw) > MAX_BYTES:
        raise PaperError(f"{path}: {len(raw)} bytes; a paper's YAML file has at most {MAX_BYTES}")
    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError as error:
        raise PaperError(f"{path}: byte {error.start} is not UTF-8; save the file as UTF-8") from None
    try:
        _refuse_references(text, path)
        node = yaml.compose(text, Loader=LOADER)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark else 1
        raise PaperError(f"{path}:{line}: not valid YAML: {error.problem or error.context}") from None
    except yaml.YAMLError as error:
        raise PaperError(f"{path}: not valid YAML: {' '.join(str(error).split())}") from None
    except RecursionError:
        raise PaperError(f"{path}: nested too deeply; at most {MAX_DEPTH} levels") from None
    if node is None:
        raise PaperError(f"{path}: the file is empty")
    lines = Lines()
    return _plain(node, path, (), lines), lines


def _refuse_references(text: str, path: Path) -> None:
    depth = 0
    for event in yaml.parse(text, Loader=LOADER):
        line = event.start_mark.line + 1 if event.start_mark else 1
        if isinstance(event, yaml.AliasEvent):
            raise PaperError(f"{path}:{line}: alias *{event.anchor}; write the value out, aliases are refused")
        anchor, tag = getattr(event, "anchor", None), getattr(event, "tag", None)
        if anchor:
            raise PaperError(f"{path}:{line}: anchor &{anchor}; anchors are refused")
        if tag:
            raise PaperError(f"{path}:{line}: tag {tag}; all scalars are text, tags are refused")
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > MAX_DEPTH:
                raise PaperError(f"{path}:{line}: nested too deeply; at most {MAX_DEPTH} levels")
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


def _plain(node: yaml.Node, path: Path, place: tuple[str | int, ...], lines: Lines) -> Any:
    lines.setdefault(place, node.start_mark.line + 1)
    if isinstance(node, yaml.ScalarNode):
        is_null = node.style is None and node.value in ("", "~", "null")
        return None if is_null else str(node.value)
    if isinstance(node, yaml.SequenceNode):
        return [_plain(item, path, (*place, index), lines) for index, item in enumerate(node.value)]
    result: dict[str, Any] = {}
    for key_node, value_node in node.value:
        line = key_node.start_mark.line + 1
        if not isinstance(key_node, yaml.ScalarNode):
            raise PaperError(f"{path}:{line}: a key must be a word")
        key = str(key_node.value)
        if key in result:
            raise PaperError(f"{path}:{line}: key {key!r} stands twice; keep one")
        lines[(*place, key)] = line
        result[key] = _plain(value_node, path, (*place, key), lines)
    return result
