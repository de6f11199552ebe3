"""Theorems 1 and 2: what their inequalities prove, at the published gains and for every X."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb, fmpq

from recontrol.claims.proofs import proven, provided, undecided, verified
from recontrol.claims.values import Identity, Result, Size, Statement, certified
from recontrol.lmi import verify

from .. import algebra as a
from .. import plant, problems

TIGHT = fmpq(1, 10**6)


def _rho(certificate: Any) -> fmpq:
    return verify.number(certificate["data"]["rho"])


def equivalence(certificates: Any, synthesis: Any) -> Result:
    """With N2, N3 tied and (iv) corrected, rho may come within 1e-6 of the squared H2 norm, both gains, both forms.

    Feasible there: certificates. Not below: (iii) and (iv) imply (17) and its dual, so rho exceeds the squared norm.
    """
    margins, evidence = {}, {}
    for gain in plant.GAINS:
        squared = synthesis["fixed-gain"][gain]["h2_squared"]
        evidence[f"h2^2, K_{gain}"] = squared
        for form in ("iii", "iv"):
            name = f"thm1-{form}-{gain}"
            rho = _rho(certificates[name])
            excess = rho / squared - 1
            margins[f"({form}), K_{gain}: within 1e-6"] = provided(verified(certificates, name), TIGHT - excess)
            margins[f"({form}), K_{gain}: above"] = excess
            evidence[f"proven rho of ({form}), K_{gain}"] = rho
    return Result(Statement(margins), evidence)


def guarantee(certificates: Any, synthesis: Any) -> Result:
    """At a proven feasible point of the printed LMIs, root of rho less the H2 norm of the loop: a guarantee needs >=
    0."""
    margins, evidence = {}, {}
    for gain in plant.GAINS:
        name = f"thm2-printed-{gain}"
        norm = synthesis["norms"][plant.DEFAULT][gain]["h2"]
        bound = arb(_rho(certificates[name])).sqrt()
        margins[f"K_{gain}"] = provided(verified(certificates, name), bound - norm)
        evidence |= {f"root of the proven rho, K_{gain}": bound, f"H2 norm, K_{gain}": norm}
        evidence[f"H2 norm over the root of rho, K_{gain}"] = norm / bound
    evidence["least rho of K_ext over that of K_trad, Theorem 2"] = _ratio(synthesis, "prt")
    evidence["h2^2 of K_ext over that of K_trad"] = _ratio(synthesis, None)
    return Result(Statement(margins, strict=False), evidence)


def _ratio(synthesis: Any, kind: str | None) -> arb:
    ext, trad = (synthesis["fixed-gain"][gain] for gain in ("ext", "trad"))
    if kind is None:
        return ext["h2_squared"] / trad["h2_squared"]
    return ext[kind]["rho"][2] / trad[kind]["rho"][2]


def vacuity() -> Identity:
    """For every X > 0, Q = (B2 B2' + X^{-1})^{-1} and N2 = -X - Q'A make block (1,2) of (26) zero and leave -Q.

    With W = Q^{-1} = B2 B2' + X^{-1}, the Schur complement of (26) is -Q - Q' + Q'(B2 B2' + X^{-1})Q; Q is symmetric.
    """
    import sympy as sp

    X, Y, Q, W, A, B = a.symbols("X Y Q W A B")
    N2 = -X - a.T(Q) * A
    corner = a.T(Q) * A + N2 + X
    inner = a.T(Q) * (B * a.T(B) + Y) * Q
    symmetric = {a.symbol("Qt"): Q, a.symbol("Wt"): W, B * a.T(B): W - Y}
    complement = (-Q - a.T(Q) + inner).subs(symmetric)
    left = a.flat(corner, complement.subs(a.symbol("Qt"), Q))
    return Identity(left, (sp.Integer(0), -Q))


SAMPLES = 200


def vacuity_samples(data: Any) -> Result:
    """The same on 200 random X of twelve orders of magnitude, exactly: (26) < 0 at the stated Q and N2."""
    from recontrol.exact.ball import precision
    from recontrol.exact.linalg import is_positive_definite
    from recontrol.exact.rational import from_float

    from .. import conditions

    rng = np.random.default_rng(0)
    si = plant.matrices(data, plant.exact_rate(data))
    proven = 0
    with precision(400):
        for _ in range(SAMPLES):
            factor = rng.normal(size=(6, 6)) * 10.0 ** rng.uniform(-3, 3, size=(6, 1))
            L = from_float(factor)
            X = L @ L.T + from_float(1e-6 * np.eye(6))
            Q, N2 = problems.vacuous(X, si["A"], si["B2"])
            matrix = conditions.thm1_iii(X, Q, N2, si["A"], si["B2"])
            proven += is_positive_definite(-matrix)
    return Result(Statement({"samples proven, less 199": fmpq(proven - SAMPLES + 1)}), {"proven samples": proven})


def tied_shared(data: Any, certificates: Any) -> Result:
    """N2 tied and one X: contradiction for both gains. Us, Vs > 0 for the whole interval of omega0, in balls."""
    from recontrol.exact.ball import precision
    from recontrol.exact.linalg import is_positive_definite

    from ..certificates.theorems import symmetriser

    margins: dict[str, Any] = {}
    with precision(plant.BITS):
        rate = plant.rate_interval(data)
        for gain in plant.GAINS:
            matrices = plant.matrices(data, rate)
            loop = plant.closed_loop(matrices, data[plant.GAINS[gain]])
            Ms = -loop[3:6, 0:3]
            V = symmetriser(Ms)
            product = Ms @ V
            for i in range(3):
                for j in range(i):
                    product[i, j] = product[j, i]
            definite = is_positive_definite(V) and is_positive_definite(product)
            found = verified(certificates, f"tied-shared-{gain}")
            margins[f"contradiction, K_{gain}"] = provided(found, arb(1)) if definite else undecided()
    return Result(Statement(margins), {}, certificate="tied-shared-ext")


def tied_separate(certificates: Any) -> Result:
    """N2 tied and two Lyapunov matrices: holds for K_ext and for K_trad; open if either does not verify."""
    names = {f"K_{gain}": f"tied-separate-{gain}" for gain in plant.GAINS}
    evidence = {gain: certified(certificates[name]).why for gain, name in names.items()}
    return Result(verified(certificates, *names.values()), evidence, certificate="tied-separate-ext")


def lyapunov_w(data: Any) -> Size:
    """W = KX of Theorem 2."""
    K = data["K_ext"]
    return Size(*K.shape)


def lyapunov_x(data: Any) -> Result:
    """X, which stands in both inequalities: the only Lyapunov matrix of Theorem 2, and one and the same for both
    norms."""
    n = data["K_ext"].shape[1]
    return Result(
        Size(n, n), {"Lyapunov matrix of (26)": "X^{-1} by (17)", "Lyapunov matrix of (8)": "the same letter X"}
    )


def admissible_ext(certificates: Any) -> Result:
    """K_ext satisfies the printed LMIs of Theorem 2 at gamma_inf = 1.01e-3."""
    return proven(certificates, "thm2-printed-ext")


def admissible_trad(certificates: Any) -> Result:
    """K_trad satisfies Lemmas 1 and 2 with one X and W = Q at gamma_inf = 1.01e-3."""
    return proven(certificates, "lemmas-trad")


def conservatism_printed(certificates: Any, synthesis: Any) -> Result:
    """What the two published gains prove about the two methods.

    A less conservative method would reach what the other cannot. But Theorem 2 as printed certifies less than the
    truth, and K_ext satisfies the *traditional* LMIs at every level with a smaller rho than K_trad needs.
    """
    fixed = synthesis["fixed-gain"]
    levels = [f"{g:g}" for g in fixed["ext"]["levels"]]
    traditional = zip(levels, fixed["trad"]["trad"]["rho"], fixed["ext"]["trad"]["rho"], strict=True)
    evidence = {f"rho that K_trad needs over that of K_ext, g = {g}": trad / ext for g, trad, ext in traditional}
    inner = guarantee(certificates, synthesis)
    margins = {f"Theorem 2 bounds the norm, {name}": value for name, value in inner.value.margins.items()}
    for g, trad, ext in zip(levels, fixed["trad"]["trad"]["rho"], fixed["ext"]["trad"]["rho"], strict=True):
        margins[f"K_ext is out of reach of the traditional LMIs, g = {g}"] = ext - trad
    return Result(Statement(margins), evidence)


def conservatism_dilated(synthesis: Any, case: str) -> Result:
    """Certified gamma2 with one X less the best certified with two and a slack, at the effort of K_ext, level
    ``case``."""
    from recontrol.claims.values import Approx

    level = case.removeprefix("g-")
    one = synthesis["single"]["std"][level]["certified"]
    two = synthesis["dilated"]["levels"][level]["certified"]
    floor = synthesis["h2-effort"]["ext"]["h2_lower"]
    evidence = {"one X": one, "two and a slack": two, "true optimum": floor}
    # Proven upper bounds, stored as floats.
    return Result(Statement({"one X less two": Approx(one - two, 1e-12)}), evidence)
