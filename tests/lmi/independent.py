"""A second opinion on certificates: plain fractions, other algorithms, and no code of the verifier.

An entry is an interval (low, high) of fractions. Answers are True, False, or None where neither could be decided
(balls only). Raises ValueError and its like for what cannot be read, which counts as False.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from itertools import product
from math import lcm

UNREADABLE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, RecursionError)


def fraction(text):
    numerator, _, denominator = text.strip().partition("/")
    return Fraction(int(numerator), int(denominator or "1"))


def interval(entry):
    if isinstance(entry, str):
        return (fraction(entry),) * 2
    mid, rad = fraction(entry["mid"]), fraction(entry["rad"])
    if rad < 0:
        raise ValueError("negative radius")
    return mid - rad, mid + rad


def plus(a, b):
    return a[0] + b[0], a[1] + b[1]


def times(a, b):
    ends = [x * y for x in a for y in b]
    return min(ends), max(ends)


def common(a, b):
    return max(a[0], b[0]), min(a[1], b[1])


def minus(a, b):
    return a[0] - b[1], a[1] - b[0]


def all_of(answers):
    """False if one is, else None if one is, else True."""
    answers = list(answers)
    return False if False in answers else None if None in answers else True


# -- definiteness -----------------------------------------------------------------------------------------------------


def definite(M):
    """Sylvester's criterion by Bareiss' fraction-free determinants of integers."""
    W = integers(M)
    before = 1
    for k in range(len(W)):
        if W[k][k] <= 0:
            return False
        for i in range(k + 1, len(W)):
            for j in range(k + 1, len(W)):
                W[i][j] = (W[i][j] * W[k][k] - W[i][k] * W[k][j]) // before
        before = W[k][k]
    return True


def semidefinite(M):
    """Elimination that always takes a positive diagonal entry; what is left must be zero."""
    W = [list(row) for row in M]
    while W:
        n = len(W)
        if any(W[i][i] < 0 for i in range(n)):
            return False
        pivot = max(range(n), key=lambda i: W[i][i])
        if W[pivot][pivot] == 0:
            return all(x == 0 for row in W for x in row)
        rest = [i for i in range(n) if i != pivot]
        W = [[W[i][j] - W[i][pivot] * W[pivot][j] / W[pivot][pivot] for j in rest] for i in rest]
    return True


def integers(M):
    factor = reduce(lcm, (x.denominator for row in M for x in row), 1)
    return [[int(x * factor) for x in row] for row in M]


def holds(rows, sense):
    """Whether every symmetric matrix within the intervals is > 0, >= 0, or = 0."""
    n = len(rows)
    if sense == "=":
        return all(low == high == 0 for row in rows for low, high in row)
    if sense not in (">", ">=") or n == 0 or any(len(row) != n for row in rows):
        return False
    joint = [
        [(max(rows[i][j][0], rows[j][i][0]), min(rows[i][j][1], rows[j][i][1])) for j in range(n)] for i in range(n)
    ]
    if any(low > high for row in joint for low, high in row):
        return False
    mid = [[(low + high) / 2 for low, high in row] for row in joint]
    reach = [[(high - low) / 2 for low, high in row] for row in joint]
    if not any(x for row in reach for x in row):
        return definite(mid) if sense == ">" else semidefinite(mid)
    inner = [[x - (sum(reach[i]) if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(mid)]
    if definite(inner):
        return True
    return False if not all(map(semidefinite, corners(mid, reach))) else None


def corners(mid, reach):
    """Some members of the box: the midpoint, and the one that is least along each sign pattern of a few."""
    yield mid
    n = len(mid)
    patterns = list(product((1, -1), repeat=n)) if n <= 4 else [[1] * n, [(-1) ** i for i in range(n)]]
    for signs in patterns:
        yield [[mid[i][j] - signs[i] * signs[j] * reach[i][j] for j in range(n)] for i in range(n)]


# -- the statements ---------------------------------------------------------------------------------------------------


def true_arithmetic(c):
    """Whether what stands in the file follows from what stands in the file."""
    try:
        if not boxes_fit(c):
            return False
        if c["proof"] == "point" and c["statement"] in ("definite", "membership", "box", "bound"):
            return true_point(c, [(m["sense"], dense(m["matrix"])) for m in c["matrices"]], unknowns(c))
        if c["proof"] == "multipliers" and c["statement"] in ("infeasible", "exclusion", "bound"):
            return true_multipliers(c, [read_form(f) for f in c["forms"]], objective(c))
    except UNREADABLE:
        return False
    return False


def boxes_fit(c):
    if c["statement"] == "bound":
        return True
    return bool(c["boxes"]) == (c["statement"] in ("membership", "exclusion"))


def dense(rows):
    return [[interval(x) for x in row] for row in rows]


def unknowns(c):
    return [fraction(x) for x in c["witness"]["unknowns"]] if c["statement"] == "bound" else []


def objective(c):
    coefficients = c["objective"]["coefficients"]
    if any(str(int(i)) != i or int(i) < 0 for i in coefficients):
        raise ValueError("no index")
    return fraction(c["objective"]["constant"]), {int(i): fraction(x) for i, x in coefficients.items()}


def true_point(c, matrices, x):
    for name, (low, high) in c["boxes"].items():
        for lows, values, highs in zip(dense(low), dense(c["witness"]["point"][name]), dense(high), strict=True):
            for lo, v, hi in zip(lows, values, highs, strict=True):
                if not lo[1] <= v[0] or not v[1] <= hi[0]:
                    return False
    answer = bool(matrices) and all_of(holds(M, sense) for sense, M in matrices)
    if c["statement"] == "bound" and answer is not False:
        constant, costs = objective(c)
        value = constant + sum(k * x[i] for i, k in costs.items())
        side, sign = ("upper", 1) if c["sense"] == "min" else ("lower", -1)
        if c["sense"] not in ("min", "max") or c["bound"]["side"] != side:
            return False
        return answer if value <= sign * fraction(c["bound"]["value"]) else False
    return answer


def read_form(f):
    """Name, sense, size and dense constant and coefficients (rows of intervals) of a stored form."""
    width = f["size"]
    if f["sense"] == "=":
        places = [e for M in (f["constant"], *f["coefficients"].values()) for e in M]
        width = max((e[1] + 1 for e in places), default=1)
    matrices = {int(i): spread(M, f["size"], width, f["sense"]) for i, M in f["coefficients"].items()}
    if any(str(int(i)) != i or int(i) < 0 for i in f["coefficients"]):
        raise ValueError("no index")
    return f["name"], f["sense"], spread(f["constant"], f["size"], width, f["sense"]), matrices


def spread(entries, n, m, sense):
    if max(n, m) > 1000:
        raise ValueError("too large")
    M = [[(Fraction(0), Fraction(0))] * m for _ in range(n)]
    for i, j, value in entries:
        if type(i) is not int or type(j) is not int or not (0 <= i < n and 0 <= j < m) or (sense != "=" and i > j):
            raise ValueError("no place")
        M[i][j] = plus(M[i][j], interval(value))
        if sense != "=" and i != j:
            M[j][i] = M[i][j]
    return M


def inner(Z, M):
    total = (Fraction(0), Fraction(0))
    for zs, ms in zip(Z, M, strict=True):
        for z, m in zip(zs, ms, strict=True):
            if any(m) and any(z):
                total = plus(total, times(z, m))
    return total


def true_multipliers(c, forms, costs):
    """Weak duality: g(x) = c0 + c'x - sum <Z, M(x)> is bounded below over the boxes by g's value at their worst end."""
    constant, coefficients = costs
    value, rest = (constant, constant), {i: (k, k) for i, k in coefficients.items()}
    strict, answers, witness = False, [True], c["witness"]
    for name, sense, M0, matrices in forms:
        if name in list(witness["slack"]):
            continue
        Z = dense(witness["multipliers"][name])
        if sense == "=":
            Z = [row + [(Fraction(0),) * 2] * (len(M0[0]) - len(row)) for row in Z]
            M0 = [row + [(Fraction(0),) * 2] * (len(Z[0]) - len(row)) for row in M0]
            matrices = {
                i: [row + [(Fraction(0),) * 2] * (len(Z[0]) - len(row)) for row in M] for i, M in matrices.items()
            }
        else:
            answers.append(holds(Z, ">="))
            strict |= sense == ">" and any(low > 0 or high < 0 for row in Z for low, high in row)
        value = minus(value, inner(Z, M0))
        for i, M in matrices.items():
            rest[i] = minus(rest.get(i, (Fraction(0),) * 2), inner(Z, M))
    for name, sense, M0, matrices in forms:
        if name in list(witness["slack"]):
            Z = slack_multiplier(M0, matrices, rest)
            answers.append(holds(Z, ">=") if sense != "=" else True)
            strict |= sense == ">" and holds(Z, ">") is True
    limits = unknown_boxes(c)
    for i, r in rest.items():
        if r != (0, 0):
            value = plus(value, (min(times(r, limits[i])),) * 2)
    answer = all_of(answers)
    if c["statement"] == "bound":
        side, sign = ("lower", 1) if c["sense"] == "min" else ("upper", -1)
        good = c["sense"] in ("min", "max") and c["bound"]["side"] == side
        return answer if good and value[0] >= sign * fraction(c["bound"]["value"]) else False
    if constant or coefficients:
        return False
    return answer if value[0] > 0 or (strict and value[0] >= 0) else False


def slack_multiplier(M0, matrices, rest):
    n = len(M0)
    taken = set()
    Z = [[(Fraction(0),) * 2] * n for _ in range(n)]
    if any(x != (0, 0) for row in M0 for x in row):
        raise ValueError("a constant")
    for i, M in matrices.items():
        places = [(a, b) for a in range(n) for b in range(a, n) if M[a][b] != (0, 0)]
        if len(places) != 1 or M[places[0][0]][places[0][1]] != (1, 1) or places[0] in taken:
            raise ValueError("not V > 0")
        taken |= set(places)
        a, b = places[0]
        low, high = rest.pop(i, (Fraction(0),) * 2)
        Z[a][b] = Z[b][a] = (low, high) if a == b else (low / 2, high / 2)
    return Z


def unknown_boxes(c):
    """Interval of each scalar unknown, from the boxes of the variables alone."""
    out, first = {}, 0
    for name in c["order"]:
        entries = c["variables"][name]["entries"]
        for i, j, k, sign in entries if name in c["boxes"] else ():
            low, high = (fraction(end[i][j]) for end in c["boxes"][name])
            ends = (low, high) if sign > 0 else (-high, -low)
            known = out.get(first + k, ends)
            out[first + k] = (max(known[0], ends[0]), min(known[1], ends[1]))
            if out[first + k][0] > out[first + k][1]:
                raise ValueError("empty")
        first += 1 + max(e[2] for e in entries)
    return out
