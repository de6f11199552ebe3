"""A small project tree with one paper whose claims show every verdict, written without running any stage."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

KEY = "fake2020"
DATA = Path(__file__).parent / "data"

READINGS = '''"""Readings of the loop."""


def eq55(data):
    return data["A"] - data["B"] * data["K"]


def eq55_twice(data):
    return 1
'''


def entry(place: str, printed: str, found: str, agrees: str, units: float, digits: int, of: int = 4) -> dict[str, Any]:
    return {
        "place": place, "printed": printed, "found": found, "agrees": agrees, "difference": units / 10**4,
        "units_in_last_place": units, "digits": digits, "digits_printed": of,
    }  # fmt: skip


def finding(reading: str, kind: str, agrees: str, strength: str = "ball", **more: Any) -> dict[str, Any]:
    empty = {"value": None, "units_in_last_place": None, "digits": None, "cases": [], "certificate": None}
    return {"reading": reading, "kind": kind, "agrees": agrees, "strength": strength, **empty, "evidence": {}, **more}


def claim(id: str, verdict: str, findings: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    carrying = findings[0] if findings else {}
    return {
        "id": id, "verdict": verdict, "expected": more.pop("expected", verdict), "findings": findings,
        "strength": carrying.get("strength"), "reading": carrying.get("reading"), "found": carrying.get("value"),
        "explained_by": None, "missing": [], "origin": "print", **more,
    }  # fmt: skip


def verdicts() -> list[dict[str, Any]]:
    """The claims of verdicts.json, all but ``s2-absent``."""
    printed, shift = ["-2.358", "-2.495", "-1.030", "-0.360"], ["1 0 0 0", "0 1 0 0", "0 0 1 0"]
    direct, twice = ["-1.17903", "-1.80014", "-0.51482", "-0.26243"], ["-2.35806", "-2.49527", "-1.02964", "-0.35985"]
    no = [entry(f"1,{j + 1}", printed[j], direct[j], "no", 1179.0 - 300 * j, 0) for j in range(4)]
    yes = [entry(f"1,{j + 1}", printed[j], twice[j], "yes", 0.1 * j, 4) for j in range(4)]
    source = {"file": f"papers/{KEY}/readings/loops.py", "line": 4}
    poles = [
        entry("1,1", "-0.4675+-1.0786i", "-0.4675+1.0786i", "yes", 0.3, 4),
        entry("1,2", "-0.1220+-0.4183i", "-0.1220+0.4183i", "yes", 0.2, 4),
    ]
    k2 = [entry("1,3", "0.5147", "0.514823", "no", 1.23, 3)]
    cases = [
        {"case": "yaw", "agrees": "yes", "value": "margin = 1.5", "strength": "float", "entries": []},
        {"case": "roll", "agrees": "no", "value": "margin = -0.25", "strength": "float", "entries": []},
    ]
    return [
        claim("eq6-tf", "reproduced", [finding("C (sI - A)^-1 B", "definition", "yes", "exact", value="equal")]),
        claim("eq53-poles", "reproduced-under-assumption", [
            finding("K.q1", "assumption", "yes", value="-0.46751234+1.07858i -0.12201+0.41828i", digits=4,
                    units_in_last_place=0.3, entries=poles, note="weights-q1")]),
        claim("eq55-11", "erratum", [
            finding("A - BK", "definition", "no", value="\n".join([" ".join(direct), *shift]),
                    units_in_last_place=1179.0, digits=0, entries=no, source=source,
                    evidence={"q": 1, "spectrum": [[-0.1, 0.2], [0.3, -4.5]], "deeper": {"margin": {"exact": "1/3"}}}),
            finding("A - 2BK", "explanation", "yes", value="\n".join([" ".join(twice), *shift]), entries=yes,
                    units_in_last_place=0.3, digits=4, source={**source, "line": 8})], explained_by="A - 2BK"),
        claim("eq65-2", "erratum", [
            finding("K.q1", "assumption", "no", value=". . 0.514823 .", entries=k2, units_in_last_place=1.23, digits=3),
            finding("cut", "explanation", "yes", value=". . 0.514723 .", units_in_last_place=0.23, digits=4,
                    entries=[entry("1,3", "0.5147", "0.514723", "yes", 0.23, 4)])], explained_by="cut"),
        claim("eq55-e65", "erratum", [
            finding("A - LC", "definition", "no", "exact", value="1", units_in_last_place=1.0, digits=0,
                    entries=[entry("1,1", "0", "1", "no", 1.0, 0, 1)],
                    evidence={"correct form": "a shift row has $1$", "numbers": "the right version"})],
              origin="print-or-ocr"),
        claim("eq44-K", "certified", [
            finding("published point", "definition", "yes", "exact", value="definite", certificate="loop-full")]),
        claim("s3-pattern", "not-reproduced", [
            finding("like for like", "assumption", "no", "float", value="yaw: 1.5; roll: -0.25", cases=cases)]),
        claim("fig3-curves", "unspecified", [], missing=["entry of the reference", "scales"]),
        claim("s2-broken", "failed", [
            finding("solver", "definition", "broken", "float", error="SolverError: <no> answer")],
            expected="reproduced"),
    ]  # fmt: skip


def write(root: Path) -> Path:
    """Write the tree below ``root`` and return it."""
    folder, results, figures = root / "papers" / KEY, root / "results" / KEY, root / "figures" / KEY
    for path in (folder / "readings", results / "certificates", results / "synthesis", figures):
        path.mkdir(parents=True)
    for name in ("paper.yaml", "claims.yaml", "NOTES.md"):
        shutil.copyfile(DATA / name, folder / name)
    (folder / "readings" / "loops.py").write_text(READINGS)
    content = {"paper": KEY, "claims": verdicts()}
    (results / "verdicts.json").write_text(json.dumps(content))
    quantities = [
        {"name": "margin", "case": "yaw", "value": {"value": 12.25, "error": 1e-9}, "unit": "dB", "strength": "float",
         "description": "gain margin of the loop $L(s)$"},
        {"name": "margin", "case": "roll", "value": {"exact": "1/3"}, "unit": "dB", "strength": "exact",
         "description": "gain margin of the loop $L(s)$"},
        {"name": "margin", "case": "grid", "value": [[1.0, 2.0], [3.0, 4.0]], "unit": "dB", "strength": "float",
         "description": "gain margin of the loop $L(s)$"},
    ]  # fmt: skip
    (results / "quantities.json").write_text(json.dumps(quantities))
    solver = {
        "problem": "sdp", "solver": "CLARABEL", "outcome": "optimal", "words": "solved", "reason": "",
        "value": 1.234567891, "reported": 1.2345678, "margins": {"a": 0.5, "b": 1e-9}, "iterations": 9, "seconds": 0.3,
    }  # fmt: skip
    second = {**solver, "solver": "SCS", "outcome": "inaccurate", "margins": {"b": -2e-9}}
    agreement = {"agrees": None, "spread": 0.0, "voters": ["CLARABEL"], "solvers": {"CLARABEL": solver, "SCS": second}}
    gains = {"K": {"exact": [["1179/1000", "1/2"]]}, "sdp": agreement}
    (results / "synthesis" / "lqr.json").write_text(json.dumps(gains))
    certificate = {
        "schema": "recontrol/certificate/1", "statement": "definite", "says": "the loop is stable", "paper": KEY,
        "conditions": [{"name": "lyapunov"}], "case": "yaw", "digest": "sha256:" + "ab" * 32,
    }  # fmt: skip
    (results / "certificates" / "loop-full.json").write_text(json.dumps(certificate))
    head = '<svg xmlns="http://www.w3.org/2000/svg" width="480" height="240" viewBox="0 0 80 40">'
    svg = head + '<path d="M5 35 Q 20 0 75 8" fill="none" stroke="#1d4f7c"/></svg>'
    (figures / "fig3.svg").write_text(svg)
    (figures / "fig3.csv").write_text("curve,x,y\nfull,0,0\n")
    return root
