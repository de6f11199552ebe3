"""Every way to tamper with a certificate that must not work, even with the digest computed again."""

import copy

import pytest
from flint import fmpq
from proven import CONTEXT

from recontrol.lmi import verify
from recontrol.lmi.certificate import decode, encode
from recontrol.lmi.problem import Problem
from recontrol.lmi.proof import prove_feasible
from recontrol.lmi.variables import symmetric


def resealed(certificate, change):
    """The certificate after ``change``, its digest computed again."""
    altered = copy.deepcopy(certificate)
    change(altered)
    altered["digest"] = verify.digest(altered)
    return altered


def negate(rows):
    return [[x[1:] if x.startswith("-") else x if x == "0" else "-" + x for x in row] for row in rows]


def altered_matrix(c):
    c["matrices"][1]["matrix"] = negate(c["matrices"][1]["matrix"])


def altered_multiplier(c):
    name = next(iter(c["witness"]["multipliers"]))
    c["witness"]["multipliers"][name][0][0] = "0"


def better_upper(c):
    c["bound"]["value"] = "1/5"


def better_lower(c):
    c["bound"]["value"] = "3/10"


def swapped_side(c):
    c["bound"]["side"] = "lower" if c["bound"]["side"] == "upper" else "upper"


def other_statement(c):
    c["statement"] = "infeasible" if c["proof"] == "point" else "definite"


def no_conditions(c):
    c["matrices"] = []


@pytest.mark.parametrize(
    ("kind", "change"),
    [
        ("definite", altered_matrix),
        ("definite", other_statement),
        ("definite", no_conditions),
        ("infeasible", altered_multiplier),
        ("infeasible", other_statement),
        ("lower", altered_multiplier),
        ("lower", better_lower),
        ("lower", swapped_side),
        ("upper", altered_matrix),
        ("upper", better_upper),
        ("upper", swapped_side),
    ],
)
def test_false_arithmetic_is_refused_even_with_a_new_digest(made, tmp_path, kind, change):
    assert not verify.check(resealed(made[kind], change), tmp_path).holds


def altered_witness(c):
    c["witness"]["point"]["P"] = negate(c["witness"]["point"]["P"])


def friendlier_matrix(c):
    c["matrices"][1]["matrix"] = [["1", "0"], ["0", "1"]]


def friendlier_data(c):
    c["data"]["A"][1][1] = "-4"


def dropped_condition(c):
    c["conditions"].pop()
    c["matrices"].pop()


def other_sense(c):
    c["conditions"][1]["sense"] = ">"


def foreign_function(c):
    c["conditions"][1]["function"] = "os:system"


def foreign_paper_function(c):
    c["conditions"][1]["function"] = "papers.proven2024.conditions:absent"


def other_case(c):
    c["case"] = "flipped" if c["case"] == "plain" else "plain"


def friendlier_form(c):
    c["forms"][1]["coefficients"]["0"] = [[0, 0, "1"]]
    c["witness"]["multipliers"] = {"lyapunov": [["1", "0"], ["0", "0"]]}


def doubled_form(c):
    """Still infeasible, by the same multipliers, but not the paper's coefficients."""
    for entries in c["forms"][1]["coefficients"].values():
        for e in entries:
            e[2] = str(2 * fmpq(*map(int, e[2].split("/"))))


def other_objective(c):
    c["objective"]["constant"] = "-1"
    c["bound"]["value"] = "0"


@pytest.mark.parametrize(
    ("kind", "change"),
    [
        ("definite", altered_witness),
        ("definite", friendlier_matrix),
        ("definite", friendlier_data),
        ("definite", other_sense),
        ("definite", foreign_function),
        ("definite", foreign_paper_function),
        ("definite", other_case),
        ("infeasible", friendlier_data),
        ("infeasible", friendlier_form),
        ("infeasible", doubled_form),
        ("infeasible", other_case),
        ("upper", altered_witness),
        ("upper", other_objective),
    ],
)
def test_true_arithmetic_about_something_else_is_refused_with_the_paper(made, root, kind, change):
    found = verify.check(resealed(made[kind], change), root)
    assert not found.holds, found.why


def test_doubled_coefficients_are_true_arithmetic(made, tmp_path):
    """What refuses them above is the comparison with the paper, nothing else."""
    assert verify.check(resealed(made["infeasible"], doubled_form), tmp_path).holds


def test_a_new_digest_is_accepted_while_the_statement_is_true(made, root):
    """Another Lyapunov matrix, with its own right matrices: true, so accepted."""

    def scaled(c):
        double = decode(c["witness"]["point"]["P"]) * fmpq(2)
        c["witness"]["point"]["P"] = encode(double)
        for item in c["matrices"]:
            item["matrix"] = encode(decode(item["matrix"]) * fmpq(2))

    assert verify.check(resealed(made["definite"], scaled), root).holds

    def weaker(c):
        c["bound"]["value"] = "1"

    assert verify.check(resealed(made["upper"], weaker), root).holds


def test_fewer_conditions_are_another_statement_and_say_so(made, root):
    found = verify.check(resealed(made["definite"], dropped_condition), root)
    assert found.holds
    assert found.why.startswith("1 condition(s)")


def test_data_that_the_paper_does_not_give_are_named(conditions, data, root):
    c = conditions
    given = {"A": data["A"], "gamma2": fmpq(1), "B": data["B"], "C": data["C"]}
    problem = Problem("gain", {"P": symmetric(2)}, [c["definite"], c["bounded_real"]], given, **CONTEXT)
    found = verify.check(prove_feasible(problem, problem.solve()), root)
    assert found.holds
    assert found.why.endswith("data that the paper does not give: gamma2")


def test_ball_data_are_proven_again_with_the_paper(conditions, data, root):
    from recontrol.paper import load

    c = conditions
    box = load(root / "papers" / "proven2024").data.ball("K")
    given = {"A": data["A"], "K": box, "B": data["B"], "C": data["C"]}
    from recontrol.lmi.conditions import condition

    bounded = condition(c["bounded_real"], rename={"gamma2": "K"})
    problem = Problem("gain", {"P": symmetric(2)}, [c["definite"], bounded], given, **CONTEXT)
    with pytest.raises(ArithmeticError):  # 0.25 is the optimum, and the box of "0.25" reaches below it
        prove_feasible(problem, problem.solve())
    short = Problem(
        "short", {"P": symmetric(2)}, [c["definite"], c["lyapunov"]], {"A": data["A"] * box}, paper="proven2024"
    )
    certificate = prove_feasible(short, short.solve())
    found = verify.check(certificate, root)
    assert found.holds
    assert found.strength == "ball"

    def narrower(cert):
        for row in cert["data"]["A"]:
            for x in row:
                if isinstance(x, dict):
                    x["rad"] = "0"

    with_source = resealed(certificate, lambda cert: cert.update(source=CONTEXT["source"], case="plain"))
    assert not verify.check(resealed(with_source, narrower), root).holds


@pytest.mark.parametrize(
    "change",
    [
        lambda c: c.update(schema="recontrol/certificate/0"),
        lambda c: c.pop("proof"),
        lambda c: c.pop("matrices"),
        lambda c: c["matrices"][0].update(matrix=[["1", "0"]]),
        lambda c: c["matrices"][0].update(matrix=[["1", "0"], ["1/2", "1"]]),
        lambda c: c["matrices"][0].update(matrix=[["nan", "0"], ["0", "1"]]),
        lambda c: c["matrices"][0].update(matrix=[[0.5, "0"], ["0", "1"]]),
        lambda c: c["matrices"][0].update(matrix=[[{"mid": "1/3", "rad": "0"}, "0"], ["0", "1"]]),
        lambda c: c.update(precision="many"),
    ],
)
def test_malformed_certificates_are_refused_in_words(made, change):
    found = verify.check(resealed(made["definite"], change))
    assert not found.holds
    assert found.why


def test_a_negative_slack_is_no_multiplier(made, tmp_path):
    """A condition marked as slack must be of the form V > 0."""

    def bend(c):
        c["forms"][0]["coefficients"]["0"] = [[0, 0, "-1"]]

    assert not verify.check(resealed(made["infeasible"], bend), tmp_path).holds

    def twice(c):
        c["forms"][0]["coefficients"]["1"] = [[0, 0, "1"]]

    assert not verify.check(resealed(made["infeasible"], twice), tmp_path).holds
