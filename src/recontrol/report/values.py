"""Values of artifacts for pages and command line: one line, nested evidence, rows of solvers and quantities."""

from __future__ import annotations

from typing import Any

from recontrol.report import numbers

ROW = 6
"""Longest row of numbers that is written on one line."""


def one_line(value: Any, digits: int = 6) -> str:
    """Return any artifact value in one line, numbers to that many significant digits."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str) and numbers.to_fraction(value) is None:
        lines = value.strip().splitlines()
        return numbers.rounded_text(value) if len(lines) <= 1 else f"{len(lines)} rows"
    cells = numbers.decode(value)
    if cells is not None:
        if sum(map(len, cells)) == 1:
            return numbers.write(cells[0][0], digits)
        if len(cells) == 1 and len(cells[0]) <= ROW:
            return "(" + ", ".join(numbers.write(cell, 5) for cell in cells[0]) + ")"
        return f"{len(cells)} × {max(map(len, cells))} matrix"
    if isinstance(value, dict):
        inner = [f"{name} {one_line(item)}" for name, item in value.items() if one_line(item)]
        return ", ".join(inner[:4]) + (" …" if len(inner) > 4 else "")
    if isinstance(value, list):
        return ", ".join(one_line(item) for item in value[:4]) + (" …" if len(value) > 4 else "")
    return str(value)


def tree(value: Any) -> tuple[str, Any]:
    """Return a value for nested display: (kind, content) with kind text, matrix, map or list."""
    if isinstance(value, dict) and numbers.decode(value) is None:
        return "map", [(str(name), tree(item)) for name, item in value.items()]
    if isinstance(value, str):
        grid = numbers.cells_of_text(value) if "\n" in value else None
        return ("text", value) if grid is None else ("matrix", grid)
    cells = numbers.decode(value)
    if cells is not None and sum(map(len, cells)) > 1:
        return "matrix", [[numbers.write(cell) for cell in row] for row in cells]
    if isinstance(value, list):
        return "list", [tree(item) for item in value]
    return "text", one_line(value)


def is_nested(value: Any) -> bool:
    """Say whether a value needs more than one line; a short row of numbers does not."""
    kind, content = tree(value)
    return kind != "text" and not (kind == "matrix" and len(content) == 1 and len(content[0]) <= ROW)


def quantile_text(ends: Any) -> str:
    """Return the middle of a bracketed quantile to three digits; the bracket is about a percent wide."""
    return one_line((ends[0] + ends[1]) / 2, 3)


SOLVER_COLUMNS = {
    "solver": "solver",
    "outcome": "outcome",
    "status": "status",
    "words": "in its own words",
    "value": "value at its point",
    "reported": "value it reports",
    "least margin": "least margin",
    "iterations": "iterations",
    "reason": "why not taken as it is",
}
"""Keys of a solver record to show and their headings; what varies from run to run (times) is not among them."""


def solver_columns(rows: list[dict[str, Any]]) -> dict[str, str]:
    """Return the columns that some row fills."""
    return {key: name for key, name in SOLVER_COLUMNS.items() if any(solver_cell(row, key) for row in rows)}


def solver_cell(row: dict[str, Any], key: str) -> str:
    """Return one cell of the solver table."""
    if key == "least margin":
        margins = row.get("margins")
        known = [value for value in margins.values() if value is not None] if isinstance(margins, dict) else []
        return one_line(min(known), 2) if known and all(isinstance(value, (int, float)) for value in known) else ""
    return one_line(row.get(key))


def quantity_groups(rows: list[dict[str, Any]]) -> list[tuple[dict[str, Any], list[dict[str, Any]]]]:
    """Return (first row, rows) of each quantity, in the order of paper.yaml."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        groups.setdefault(str(row.get("name")), []).append(row)
    return [(group[0], group) for group in groups.values()]
