"""Gains, models and time series for other tools: MATLAB files, plain JSON, CSV.

Everything becomes floating point here: rationals are rounded, balls give their midpoint. The artifacts stay the
record; these are conveniences made from them.
"""

from __future__ import annotations

import csv
import io
import json
import re
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from recontrol.report.collect import Paper

EPOCH = (1980, 1, 1, 0, 0, 0)
HEADER = b"MATLAB 5.0 MAT-file, written by recontrol".ljust(116)
FIELD = 63
"""Longest name of a MATLAB structure field."""


def files(root: Path, key: str) -> dict[str, bytes]:
    """Return path (relative to the project) -> content of the exports of one paper."""
    paper = Paper(Path(root), key)
    made: dict[str, bytes] = {}
    for name, content in (("model", decoded(paper.results / "model.json")), ("synthesis", synthesis(paper))):
        values = plain(content)
        text = json.dumps(_listed(values), sort_keys=True, indent=1, allow_nan=False) + "\n"
        made[f"results/{key}/{name}.plain.json"] = text.encode()
        made[f"results/{key}/{name}.mat"] = mat(values)
    made[f"results/{key}/series.zip"] = series(paper)
    return made


def decoded(path: Path) -> Any:
    """Return an artifact with its rationals, balls and arrays as objects; an empty mapping if it is missing."""
    from recontrol.pipeline import encode

    return encode.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def synthesis(paper: Paper) -> dict[str, Any]:
    """Return the decoded synthesis artifacts by part."""
    return {path.stem: decoded(path) for path in sorted((paper.results / "synthesis").glob("*.json"))}


def plain(value: Any) -> Any:
    """Return a decoded artifact in floats: scalars, arrays of floats or complex numbers, text, and nested mappings."""
    import numpy as np

    from recontrol.approx import Approx

    if isinstance(value, Mapping):
        if set(value) == {"re", "im"}:
            return complex(_float(plain(value["re"])), _float(plain(value["im"])))
        return {str(name): plain(item) for name, item in value.items()}
    if isinstance(value, Approx):
        return plain(value.value)
    if isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.dtype == object):
        items = [plain(item) for item in value]
        try:
            array = np.array(items)
        except ValueError:
            return items
        return array if array.dtype.kind in "biufc" else items
    if value is None or isinstance(value, (bool, int, float, complex, str, np.ndarray)):
        return value
    return float(value.mid()) if hasattr(value, "mid") else _float(value)


def _float(value: Any) -> float:
    return int(value.p) / int(value.q) if hasattr(value, "q") else float(value)


def _listed(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _listed(item) for name, item in value.items()}
    if isinstance(value, complex):
        return {"re": value.real, "im": value.imag}
    if isinstance(value, list):
        return [_listed(item) for item in value]
    if hasattr(value, "tolist"):
        complex_array = getattr(value, "dtype", None) is not None and value.dtype.kind == "c"
        return {"re": value.real.tolist(), "im": value.imag.tolist()} if complex_array else value.tolist()
    return value


def mat(values: Mapping[str, Any]) -> bytes:
    """Return a MATLAB file whose bytes depend on the values alone; names that MATLAB refuses get underscores."""
    from scipy.io import savemat

    buffer = io.BytesIO()
    savemat(buffer, _fields(values), long_field_names=True, oned_as="column", do_compression=True)
    return HEADER + buffer.getvalue()[len(HEADER) :]


def _fields(values: Mapping[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in values.items():
        field = _unused(re.sub(r"\W", "_", name), found)
        found[field] = _fields(value) if isinstance(value, Mapping) else _cell(value)
    return found


def _unused(name: str, taken: Mapping[str, Any]) -> str:
    name = ("x" + name if not name[:1].isalpha() else name)[: FIELD - 3]
    number = 1
    field = name
    while field in taken:
        number += 1
        field = f"{name}_{number}"
    return field


def _cell(value: Any) -> Any:
    import numpy as np

    if value is None:
        return np.empty((0, 0))
    if isinstance(value, list):
        cells = np.empty(len(value), dtype=object)
        for k, item in enumerate(value):
            cells[k] = _fields(item) if isinstance(item, Mapping) else _cell(item)
        return cells
    return value


def series(paper: Paper) -> bytes:
    """Return a zip with one CSV for each simulation part; columns shorter than the longest end in empty cells."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted((paper.results / "simulation").glob("*.npz")):
            text = _table(path)
            if text:
                archive.writestr(zipfile.ZipInfo(f"{path.stem}.csv", EPOCH), text, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def _table(path: Path) -> str:
    import numpy as np

    columns: dict[str, Any] = {}
    with np.load(path, allow_pickle=False) as arrays:
        for name in arrays.files:
            for label, column in _columns(name, arrays[name]):
                columns[label] = column
    if not columns:
        return ""
    head = io.StringIO()
    csv.writer(head, lineterminator="\n").writerow(columns)
    length = max(len(column) for column in columns.values())
    padded = [[*map(repr, column.tolist())] + [""] * (length - len(column)) for column in columns.values()]
    return head.getvalue() + "".join(f"{','.join(row)}\n" for row in zip(*padded, strict=True))


def _columns(name: str, array: Any) -> list[tuple[str, Any]]:
    import numpy as np

    if np.iscomplexobj(array):
        return [*_columns(f"{name}.re", array.real), *_columns(f"{name}.im", array.imag)]
    array = np.atleast_1d(array)
    if array.ndim == 1:
        return [(name, array)]
    flat = array.reshape(array.shape[0], -1)
    places = np.ndindex(array.shape[1:])
    return [(f"{name}[{','.join(str(i + 1) for i in place)}]", flat[:, k]) for k, place in enumerate(places)]
