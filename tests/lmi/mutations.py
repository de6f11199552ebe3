"""Seeded damage to a certificate: any node of the file, changed, lost, doubled, renamed, or taken from another file."""

from __future__ import annotations

import copy
import random

from flint import fmpq

# fmt: off
WORDS = (
    "definite", "infeasible", "bound", "box", "membership", "exclusion", "point", "multipliers", ">", ">=", "<",
    "<=", "=", "min", "max", "upper", "lower", "plain", "flipped", "P", "A", "B", "C", "K", "gamma2", "lyapunov",
    "bounded_real", "papers.proven2024.conditions:definite", "recontrol.lmi.loops:hurwitz", "os:system",
)
# fmt: on
ODD = (None, True, 0, -1, 1.5, "", "x", "nan", "1/0", "0", "-1", [], {}, [[]], {"mid": "1", "rad": "-1"}, 10**40)
MARKS = ("statement", "proof", "sense", "side", "case", "paper", "source", "bound", "order", "boxes", "slack", "given")


def mutated(certificate, others, seed):
    """One to three changes of a copy of ``certificate``; the seed decides. The digest is left as it was."""
    rng = random.Random(seed)
    altered = copy.deepcopy(certificate)
    for _ in range(rng.choice((1, 1, 2, 3))):
        holder, key = place(altered, rng)
        change(holder, key, rng, rng.choice(others))
    return altered


def place(tree, rng):
    """A node by its holder and key: a random walk that ends early now and then, so that large matrices do not win."""
    top = rng.choice([key for key in tree if key not in ("digest", "schema", "says", "notes")])
    holder, key = tree, top
    while isinstance(holder[key], (dict, list)) and holder[key] and rng.random() < 0.9:
        holder = holder[key]
        keys = list(holder) if isinstance(holder, dict) else range(len(holder))
        marks = [k for k in keys if k in MARKS]
        key = rng.choice(marks if marks and rng.random() < 0.3 else list(keys))
    return holder, key


def change(holder, key, rng, other):
    """One change of ``holder[key]``."""
    value, kind = holder[key], rng.random()
    if kind < 0.08:
        holder[key] = copy.deepcopy(rng.choice(ODD))
    elif kind < 0.14:
        del holder[key]
    elif kind < 0.24 and isinstance(holder, dict):
        new = rng.choice((f"0{key}", f"-{key}", str(rng.randrange(4)), rng.choice(WORDS), *holder))
        holder[new] = copy.deepcopy(value) if rng.random() < 0.5 else holder.pop(key)
    elif kind < 0.3 and isinstance(holder, list):
        holder.insert(rng.randrange(len(holder) + 1), copy.deepcopy(value))
    elif kind < 0.36 and isinstance(holder, list):
        at = rng.randrange(len(holder))
        holder[key], holder[at] = holder[at], holder[key]
    elif kind < 0.42 and isinstance(holder, dict) and key in other:
        holder[key] = copy.deepcopy(other[key])
    else:
        holder[key] = altered_leaf(value, rng)


def altered_leaf(value, rng):
    """Another number or word in the place of a leaf; containers with one of their leaves altered, or emptied."""
    if isinstance(value, bool) or value is None or isinstance(value, float):
        return rng.choice((True, False, 1))
    if isinstance(value, int):
        return rng.choice((value + 1, value - 1, -value, 0, -1, 53, 100000))
    if isinstance(value, str):
        try:
            return altered_number(value, rng)
        except (ValueError, ZeroDivisionError):
            return rng.choice(WORDS)
    if not value or rng.random() < 0.1:
        return type(value)()
    keys = list(value) if isinstance(value, dict) else range(len(value))
    key = rng.choice(list(keys))
    out = copy.copy(value)
    out[key] = altered_leaf(value[key], rng)
    return out


def altered_number(text, rng):
    """A number near or far: another sign, size, last place, or place of the fraction bar."""
    p, _, q = text.partition("/")
    x = fmpq(int(p), int(q or "1"))
    near = x * (1 + fmpq(rng.choice((-1, 1)), 10 ** rng.randrange(1, 15)))
    choices = [-x, x + 1, x - 1, 10 * x, x / 10, fmpq(0), near, near, near, 1 / x if x != 0 else fmpq(1)]
    found = rng.choice(choices)
    return f"{found.p}/{found.q}" if int(found.q) != 1 else str(found.p)


def changes(old, new, place=""):
    """Where two trees differ: "/place: old -> new", the digest apart."""
    if isinstance(old, dict) and isinstance(new, dict):
        keys = [key for key in {**old, **new} if key != "digest"]
        return [d for key in keys for d in changes(old.get(key), new.get(key), f"{place}/{key}")]
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        return [d for i, (a, b) in enumerate(zip(old, new, strict=True)) for d in changes(a, b, f"{place}/{i}")]
    return [] if old == new else [f"{place}: {str(old)[:80]} -> {str(new)[:80]}"]
