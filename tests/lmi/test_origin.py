"""What a file may not smuggle in: other data, other boxes, other unknowns, another paper, behind true arithmetic."""

from __future__ import annotations

import json

import pytest
from proven import CONTEXT
from test_tampering import resealed

from recontrol import cli
from recontrol.exact import rational
from recontrol.lmi import loops, verify
from recontrol.lmi.certificate import encode, encode_variable
from recontrol.lmi.problem import Problem, ProblemError
from recontrol.lmi.proof import prove_feasible, prove_infeasible
from recontrol.lmi.variables import scalar, symmetric


def test_boxes_are_those_of_the_print(made, root):
    """Half the box: still no member, but not the box that the paper prints."""

    def narrower(c):
        low, high = c["boxes"]["S"]
        c["boxes"]["S"] = [low, [["1251/1000", high[0][1]], high[1]]]
        c["unknown_boxes"]["0"][1] = "1251/1000"

    found = verify.check(resealed(made["exclusion"], narrower), root)
    assert not found.holds
    assert "box of S differs from paper.yaml" in found.why


def test_a_box_that_the_paper_does_not_give_is_named(conditions, data, root):
    from recontrol.lmi.conditions import condition

    named = [condition(conditions[name], rename={"P": "Q"}) for name in ("definite", "lyapunov")]
    box = (rational.matrix("1 -2\n-2 1"), rational.matrix("3 -0.5\n-0.5 3"))
    problem = Problem("q", {"Q": symmetric(2)}, named, {"A": data["A"]}, boxes={"Q": box}, **CONTEXT)
    found = verify.check(prove_infeasible(problem), root)
    assert found.holds
    assert found.why.endswith("data that the paper does not give: box of Q")


@pytest.mark.parametrize(("kind", "statement"), [("exclusion", "infeasible"), ("membership", "definite")])
def test_a_statement_about_a_box_is_none_about_all_values(made, root, kind, statement):
    assert not verify.check(resealed(made[kind], lambda c: c.update(statement=statement)), root).holds


def test_boxes_of_the_unknowns_follow_from_those_of_the_variables(made, tmp_path):
    def narrower(c):
        c["unknown_boxes"]["0"][1] = "1251/1000"

    assert "boxes of the unknowns" in verify.check(resealed(made["exclusion"], narrower), tmp_path).why

    def empty(c):
        c["boxes"]["S"] = c["boxes"]["S"][::-1]
        c["unknown_boxes"] = {i: ends[::-1] for i, ends in c["unknown_boxes"].items()}

    assert "a box is empty" in verify.check(resealed(made["exclusion"], empty), tmp_path).why


def test_a_datum_in_the_witness_does_not_replace_the_papers(made, conditions, data, root):
    """The plant with the sign of A turned is unstable; a stable A among the unknowns would hide it."""
    stable = made["definite"]

    def hidden(c):
        c["case"] = "flipped"
        c["data"]["A"] = encode(-data["A"])
        c["witness"]["point"]["A"] = encode(data["A"])

    found = verify.check(resealed(stable, hidden), root)
    assert not found.holds
    assert "the list of variables" in found.why


def test_a_coefficient_does_not_hide_behind_another_spelling(made, root):
    def hidden(c):
        (index,) = c["objective"]["coefficients"]
        c["objective"]["coefficients"] = {f"0{index}": "-2", index: "1"}
        c["bound"]["value"] = "-1/5"

    assert "not the number of an unknown" in verify.check(resealed(made["upper"], hidden), root).why


@pytest.mark.parametrize("paper", ["../papers/proven2024", "/tmp", "."])
def test_a_paper_is_a_key_and_no_path(made, root, paper):
    elsewhere = resealed(made["definite"], lambda c: c.update(paper=paper))
    assert "not the key of a paper" in verify.check(elsewhere, root).why


def test_functions_of_another_paper_are_refused(made, root):
    other = root / "papers" / "other2024"
    other.mkdir(exist_ok=True)
    (other / "conditions.py").write_text((root / "papers" / "proven2024" / "conditions.py").read_text())

    def borrowed(c):
        c["conditions"][1]["function"] = "papers.other2024.conditions:lyapunov"

    assert "is no function of papers/proven2024" in verify.check(resealed(made["definite"], borrowed), root).why


def test_an_unknown_sense_is_refused(made, tmp_path):
    def turned(c):
        c["matrices"][0]["sense"] = "<"

    assert "unknown sense" in verify.check(resealed(made["definite"], turned), tmp_path).why


def test_two_unknowns_do_not_share_a_place_of_a_slack_condition(made, tmp_path):
    def mirrored(c):
        c["forms"][0]["coefficients"]["1"] = [[1, 0, "1"]]

    assert "below the diagonal" in verify.check(resealed(made["infeasible"], mirrored), tmp_path).why


def test_a_condition_of_impossible_size_asks_for_no_memory(made, tmp_path):
    def vast(c):
        c["forms"][0]["size"] = 10**9

    assert not verify.check(resealed(made["infeasible"], vast), tmp_path).holds


def test_box_lemmas_need_diagonal_multipliers(made, root):
    """[0 1; -2+d -3+e] with abs(d), abs(e) <= 1: the lemma holds for diagonal T only."""
    E, F = loops.entry_box(rational.matrix("0 0\n1 1"))
    data = {"M": rational.matrix("0 1\n-2 -3"), "E": E, "F": F}
    with pytest.raises(ProblemError, match="unless T is diagonal"):
        Problem("box", {"P": symmetric(2), "T": symmetric(2)}, [loops.box_hurwitz], data)

    def full(c):
        c["variables"]["T"] = encode_variable(symmetric(2))

    assert "unless T is diagonal" in verify.check(resealed(made["box"], lambda c: (full(c), at_home(c))), root).why


def at_home(c):
    c["paper"] = "proven2024"


def test_the_word_box_needs_a_box_lemma(made, root):
    found = verify.check(resealed(made["definite"], lambda c: c.update(statement="box")), root)
    assert not found.holds
    assert "a statement about a box" in found.why


def test_the_answer_names_case_and_conditions_and_quotes_the_file(made, root, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "c.json").write_text(json.dumps(resealed(made["definite"], lambda c: c.update(says="all is well"))))
    assert cli.main(["-C", str(root), "verify", "c.json"]) == 0
    said = capsys.readouterr().out
    assert "rebuilt from papers/proven2024, case 'plain': definite, lyapunov" in said
    assert "in the file's own words: all is well" in said
    assert cli.main(["verify", "c.json"]) == 0
    assert "arithmetic alone" in capsys.readouterr().out


def test_an_unknown_argument_is_refused(made, root):
    found = verify.check(resealed(made["definite"], lambda c: c["conditions"][1]["given"].update(kappa=1)), root)
    assert "cannot be rebuilt" in found.why


def test_a_point_has_the_structure_of_its_unknowns(conditions, data, root):
    """A symmetric matrix is no point of an unknown whose halves have opposite signs."""
    named = [conditions["definite"], conditions["lyapunov"]]
    problem = Problem("q", {"P": symmetric(2), "x": scalar()}, named, {"A": data["A"]}, **CONTEXT)
    certificate = prove_feasible(problem, {**problem.solve().point, "x": 1.0})
    assert verify.check(certificate, root).holds

    def lower_half_turned(file):
        file["variables"]["P"]["entries"][2] = [1, 0, 1, -1]

    assert not verify.check(resealed(certificate, lower_half_turned), root).holds
