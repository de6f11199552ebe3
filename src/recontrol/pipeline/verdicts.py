"""Hold every claim of a paper against what its readings find, and derive the verdicts."""

from __future__ import annotations

import argparse
import dataclasses
import traceback
from pathlib import Path
from typing import Any

from recontrol.claims import schema
from recontrol.claims.compare import Outcome, combine, compare
from recontrol.claims.schema import Claim, Reading
from recontrol.claims.values import Result, weakest
from recontrol.claims.verdict import BROKEN, Finding, derive
from recontrol.errors import RecontrolError
from recontrol.paper import Paper
from recontrol.pipeline import inputs, job
from recontrol.pipeline.encode import dumps, encode
from recontrol.pipeline.layout import artifact


def run(key: str) -> None:
    """Write results/<key>/verdicts.json."""
    paper = job.open_paper(key)
    content = {"paper": key, "claims": evaluate(paper)}
    job.publish(
        "verdicts", key, None, {artifact(key, "verdicts"): dumps(content).encode()}, inputs.earlier(paper, "verdicts")
    )


def evaluate(paper: Paper) -> list[dict[str, Any]]:
    """One record per claim. A reading that raises is `broken` and makes its claim `failed`; the others go on."""
    available = inputs.Inputs(paper, inputs.load_config(), inputs.before("verdicts"))
    return [_claim_record(claim, paper, available) for claim in schema.load(paper)]


def _claim_record(claim: Claim, paper: Paper, available: inputs.Inputs) -> dict[str, Any]:
    details = [_find(claim, reading, paper, available) for reading in claim.readings]
    verdict = derive(claim.compare, claim.unique, [finding for finding, _ in details])
    carrying = next((finding for finding, _ in details if finding.reading == verdict.reading), None)
    return {
        "id": claim.id,
        "where": claim.where,
        "title": claim.title,
        "compare": claim.compare,
        "printed": claim.printed_text(paper),
        "data": claim.data,
        "unit": claim.unit,
        "unique": claim.unique,
        "verdict": verdict.verdict,
        "expected": claim.expected.verdict,
        "strength": verdict.strength,
        "reading": verdict.reading,
        "found": carrying.value if carrying else None,
        "explained_by": explained_by(claim, verdict.explanations),
        "explanations": list(verdict.explanations),
        "missing": claim.missing,
        "origin": claim.origin,
        "notes": claim.notes,
        "findings": [{**dataclasses.asdict(finding), **extra} for finding, extra in details],
        "because": claim.because,
    }


def explained_by(claim: Claim, agreeing: tuple[str, ...]) -> str | None:
    """The reviewed explanation if it agrees, else the first that does."""
    reviewed = claim.expected.explained_by
    return reviewed if reviewed in agreeing else next(iter(agreeing), None)


def _find(claim: Claim, reading: Reading, paper: Paper, available: inputs.Inputs) -> tuple[Finding, dict[str, Any]]:
    extra: dict[str, Any] = {"function": reading.function, "note": reading.note, "source": None, "evidence": {}}
    try:
        function = inputs.function_of(paper.key, "readings", reading.function)
        extra["source"] = inputs.source_of(function, reading.function.rpartition(".")[2])
        if reading.over is None:
            outcome, result = _one(claim, reading, available.call(function), paper)
            cases: list[dict[str, Any]] = []
        else:
            outcome, result, cases = _over_cases(claim, reading, function, paper, available)
        extra["evidence"] = encode(dict(result.evidence), f"evidence of {reading.name}")
        extra["entries"] = [dataclasses.asdict(entry) for entry in outcome.entries]
        finding = Finding(
            reading=reading.name,
            kind=reading.kind,
            agrees=outcome.agrees,
            strength=outcome.strength,
            value=outcome.found,
            units_in_last_place=outcome.units_in_last_place,
            digits=outcome.digits,
            cases=cases,
            certificate=result.certificate or reading.certificate,
        )
    except Exception as error:
        extra["error"] = f"{type(error).__name__}: {error}"
        if not isinstance(error, RecontrolError):
            extra["trace"] = _short_trace(error)
        return Finding(reading.name, reading.kind, BROKEN, "float"), extra
    return finding, extra


def _one(claim: Claim, reading: Reading, returned: Any, paper: Paper) -> tuple[Outcome, Result]:
    result = returned if isinstance(returned, Result) else Result(returned)
    return compare(claim, reading.compare or claim.compare, result.value, paper), result


def _over_cases(
    claim: Claim, reading: Reading, function: Any, paper: Paper, available: inputs.Inputs
) -> tuple[Outcome, Result, list[dict[str, Any]]]:
    assert reading.over is not None
    outcomes: list[Outcome] = []
    evidence: dict[str, Any] = {}
    rows = []
    for case in reading.over.cases:
        outcome, result = _one(claim, reading, available.call(function, case=case), paper)
        outcomes.append(outcome)
        if result.evidence:
            evidence[case] = dict(result.evidence)
        rows.append(
            {
                "case": case,
                "agrees": outcome.agrees,
                "value": outcome.found,
                "strength": outcome.strength,
                "units_in_last_place": outcome.units_in_last_place,
                "digits": outcome.digits,
                "certificate": result.certificate,
                "entries": [dataclasses.asdict(entry) for entry in outcome.entries],
            }
        )
    agrees = "shown" if claim.compare == "none" else combine([o.agrees for o in outcomes], reading.over.holds)
    units = [o.units_in_last_place for o in outcomes if o.units_in_last_place is not None]
    digits = [o.digits for o in outcomes if o.digits is not None]
    total = Outcome(
        agrees=agrees,
        strength=weakest([o.strength for o in outcomes]),
        found="; ".join(f"{row['case']}: {row['value']}" for row in rows),
        units_in_last_place=max(units, default=None),
        digits=min(digits, default=None),
    )
    return total, Result(None, evidence), rows


def _short_trace(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)[-3:]
    return "; ".join(f"{Path(f.filename).name}:{f.lineno} {f.name}" for f in frames)


def main(arguments: list[str]) -> int:
    """Command line: PAPER."""
    parser = argparse.ArgumentParser(prog="recontrol.pipeline verdicts")
    parser.add_argument("paper")
    run(parser.parse_args(arguments).paper)
    return 0
