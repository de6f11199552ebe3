"""Masks of claims.yaml: which cells of a printed matrix a claim is about."""

from __future__ import annotations


def selected(entries: str | None, without: str | None, shape: tuple[int, int]) -> list[list[bool]]:
    """Return rows of booleans for masks such as ``"1:4,5:8; 2,3"`` (counted from one, ``:`` for all)."""
    chosen = _cells(entries, shape) if entries else {(i, j) for i in range(shape[0]) for j in range(shape[1])}
    chosen -= _cells(without, shape) if without else set()
    return [[(i, j) in chosen for j in range(shape[1])] for i in range(shape[0])]


def _cells(text: str, shape: tuple[int, int]) -> set[tuple[int, int]]:
    cells: set[tuple[int, int]] = set()
    for part in filter(None, (piece.strip() for piece in text.split(";"))):
        rows, _, columns = part.partition(",")
        cells |= {(i, j) for i in _span(rows, shape[0]) for j in _span(columns or ":", shape[1])}
    return cells


def _span(text: str, size: int) -> range:
    first, colon, last = text.strip().partition(":")
    if not colon:
        return range(int(first) - 1, int(first))
    return range(int(first or 1) - 1, min(int(last or size), size))
