"""Artifacts as JSON: plain numbers and nested lists, exact rationals as text, balls as midpoint and radius.

Doubles round-trip; NaN and infinity are refused. Numeric nested lists are read back as float arrays.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from typing import Any

from recontrol.approx import Approx
from recontrol.errors import ArtifactError


def dumps(tree: Any) -> str:
    """JSON text, keys sorted. Raises ArtifactError for a value without a form."""
    return json.dumps(encode(tree, "value"), allow_nan=False, sort_keys=True, indent=1, ensure_ascii=False) + "\n"


def loads(text: str) -> Any:
    """Inverse of `dumps` up to lists of numbers becoming arrays."""
    return decode(json.loads(text))


def encode(value: Any, place: str = "value") -> Any:
    """A tree of JSON types. Raises ArtifactError naming the place of a non-finite or unsupported value."""
    import numpy as np
    from flint import acb, arb, fmpq, fmpz

    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, int):
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise ArtifactError(f"{place} is {value}; artifacts hold finite numbers only (use null or a word)")
        return value
    if isinstance(value, complex):
        return {"complex": {"re": encode(value.real, place), "im": encode(value.imag, place)}}
    if isinstance(value, Mapping):
        return {str(key): encode(item, f"{place}.{key}") for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [encode(item, f"{place}[{index}]") for index, item in enumerate(value)]
    if isinstance(value, Approx):
        return {"value": encode(value.value, place), "error": encode(value.error, place)}
    if isinstance(value, (fmpq, fmpz)):
        return {"exact": str(value)}
    if isinstance(value, arb):
        return {"ball": _ball(value, place)}
    if isinstance(value, acb):
        return {"re": {"ball": _ball(value.real, place)}, "im": {"ball": _ball(value.imag, place)}}
    if isinstance(value, np.ndarray):
        return _encode_array(value, place)
    raise ArtifactError(f"{place}: a {type(value).__name__} cannot be stored in an artifact")


def _encode_array(value: Any, place: str) -> Any:
    import numpy as np
    from flint import arb, fmpq, fmpz

    if value.dtype == object:
        kinds = {type(item) for item in value.ravel()}
        if kinds and kinds <= {fmpq, fmpz, int}:
            return {"exact": _nested(value, lambda item: str(fmpq(item)))}
        if kinds and kinds <= {arb}:
            balls = [_ball(item, place) for item in value.ravel()]
            mid, rad = (np.array([b[k] for b in balls], dtype=object).reshape(value.shape) for k in ("mid", "rad"))
            return {"ball": {"mid": mid.tolist(), "rad": rad.tolist()}}
        return [encode(item, f"{place}[{index}]") for index, item in enumerate(value)]
    if np.iscomplexobj(value):
        return {"complex": {"re": _encode_array(value.real, place), "im": _encode_array(value.imag, place)}}
    if value.dtype.kind in "biu":
        return value.tolist()
    if not np.all(np.isfinite(value)):
        bad = tuple(int(i) for i in np.argwhere(~np.isfinite(value))[0])
        raise ArtifactError(f"{place}{list(bad)} is not finite; artifacts hold finite numbers only")
    return value.tolist()


def _nested(array: Any, convert: Any) -> Any:
    return [_nested(row, convert) for row in array] if array.ndim > 1 else [convert(item) for item in array]


def _ball(value: Any, place: str) -> dict[str, str]:
    if not value.is_finite():
        raise ArtifactError(f"{place} is the ball {value}; artifacts hold finite balls only")
    return {"mid": str(value.mid().fmpq()), "rad": str(value.rad().fmpq())}


def decode(tree: Any) -> Any:
    """Inverse of `encode`."""
    import numpy as np

    if isinstance(tree, dict):
        keys = set(tree)
        if keys == {"exact"}:
            return _decode_exact(tree["exact"])
        if keys == {"ball"}:
            return _decode_ball(tree["ball"])
        if keys == {"complex"}:
            re, im = decode(tree["complex"]["re"]), decode(tree["complex"]["im"])
            return complex(re, im) if isinstance(re, (int, float)) else np.asarray(re) + 1j * np.asarray(im)
        if keys == {"value", "error"}:
            return Approx(decode(tree["value"]), decode(tree["error"]))
        return {key: decode(item) for key, item in tree.items()}
    if isinstance(tree, list):
        items = [decode(item) for item in tree]
        return _as_array(items)
    return tree


def _as_array(items: list[Any]) -> Any:
    import numpy as np

    if not items:
        return items
    if all(isinstance(item, (int, float)) and not isinstance(item, bool) for item in items):
        return np.array(items, dtype=float)
    floats = all(isinstance(item, np.ndarray) and item.dtype != object for item in items)
    if floats and len({item.shape for item in items}) == 1:
        return np.array(items)
    return items


def _decode_exact(tree: Any) -> Any:
    import numpy as np
    from flint import fmpq

    def rational(text: str) -> Any:
        numerator, _, denominator = text.partition("/")
        return fmpq(int(numerator), int(denominator or 1))

    if isinstance(tree, str):
        return rational(tree)
    shape = np.shape(tree)
    array = np.empty(int(np.prod(shape)), dtype=object)
    array[:] = [rational(text) for text in np.ravel(np.array(tree, dtype=object))]
    return array.reshape(shape)


def _decode_ball(tree: dict[str, Any]) -> Any:
    import numpy as np

    from recontrol.exact.ball import from_mid_rad

    mid, rad = _decode_exact(tree["mid"]), _decode_exact(tree["rad"])
    if isinstance(mid, np.ndarray):
        balls = np.empty(mid.size, dtype=object)
        balls[:] = [from_mid_rad(m, r) for m, r in zip(mid.ravel(), rad.ravel(), strict=True)]
        return balls.reshape(mid.shape)
    return from_mid_rad(mid, rad)


def sha256(content: bytes) -> str:
    """Hex digest of bytes."""
    return hashlib.sha256(content).hexdigest()


def canonical_digest(tree: Any, digits: int = 6) -> str:
    """Digest of an encoded tree with every float rounded to `digits` significant digits.

    Survives another processor, whose last bits differ; exact text is kept as it is.
    """

    def rounded(node: Any) -> Any:
        if isinstance(node, dict):
            return {key: rounded(item) for key, item in node.items()}
        if isinstance(node, list):
            return [rounded(item) for item in node]
        if isinstance(node, float):
            return f"{node:.{digits - 1}e}" if abs(node) > 1e-12 else "0"
        return node

    return sha256(json.dumps(rounded(tree), sort_keys=True).encode())
