"""Views of claims for pages and command line: panels of numbers with the digits that differ, readings in words."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from recontrol.report import numbers, values
from recontrol.report.claim import Claim, Finding

MAX_FOUND = 3
GUARD = 2
Grid = list[list[numbers.Cell | None]]


@dataclass(frozen=True)
class CellView:
    """One cell of a panel: text in pieces (piece, differs), whether the claim is about it, distance in words."""

    pieces: list[tuple[str, bool]]
    counted: bool
    distance: str = ""


@dataclass(frozen=True)
class Panel:
    """A printed or found matrix beside the others; ``finding`` is ``None`` for the print."""

    label: str
    finding: Finding | None
    rows: list[list[CellView]]
    rows_of: str = ""
    agreeing: int = 0
    counted: int = 0


def counted_cells(panel: Panel) -> list[CellView]:
    """Return the cells of a panel that the claim is about, row by row."""
    return [cell for row in panel.rows for cell in row if cell.counted]


def printed_cells(claim: Claim) -> list[str]:
    """Return the printed cells that the claim is about; none for words."""
    return [text for i, row in enumerate(claim.rows or []) for j, text in enumerate(row) if is_counted(claim, i, j)]


def plain(value: Fraction | float) -> str:
    """Return a distance in units of the last printed place, short."""
    size = abs(Fraction(repr(value)) if isinstance(value, float) else Fraction(value))
    if size == 0:
        return "0"
    if size < Fraction(1, 1000):
        return "< 0.001"
    if size >= 10**6:
        return numbers.significant(size, 2)
    return f"{round(size):,}".replace(",", "\N{THIN SPACE}") if size >= 100 else numbers.significant(size, 2)


def fitting(claim: Claim, finding: Finding) -> Grid | None:
    """Return the found cells laid out as the printed ones, or ``None`` when there are none or the shapes differ."""
    rows, cells = claim.rows, finding.cells
    if rows is None or cells is None or claim.mask is None:
        return None
    return cells if [len(row) for row in cells] == [len(row) for row in rows] else None


def distances(finding: Finding) -> list[tuple[int, int, float, bool]]:
    """Return (row, column, distance in last-place units, agrees) of every compared cell, the largest first."""
    found = [
        (row, column, float(entry.get("units_in_last_place") or 0), entry.get("agrees") == "yes")
        for (row, column), entry in finding.entries.items()
    ]
    return sorted(found, key=lambda item: (-item[2], item[0], item[1]))


def far(finding: Finding) -> list[tuple[int, int, float, bool]]:
    """Return the compared cells that do not agree, the largest distance first."""
    return [item for item in distances(finding) if not item[3]]


def panels(claim: Claim) -> list[Panel]:
    """Return the print and beside it what the readings that matter found, each cell with its differing digits."""
    if claim.rows is None or claim.mask is None:
        return []
    ranked = sorted(claim.findings, key=lambda f: (f is not claim.decisive, f.agrees != "yes", f.kind == "explanation"))
    shown = [finding for finding in ranked if fitting(claim, finding) is not None][:MAX_FOUND]
    return [_printed_panel(claim, shown[0] if shown else None), *(_found_panel(claim, finding) for finding in shown)]


def _printed_panel(claim: Claim, against: Finding | None) -> Panel:
    rows: list[list[CellView]] = []
    cells = fitting(claim, against) if against else None
    for i, row in enumerate(claim.rows or []):
        rows.append([])
        for j, text in enumerate(row):
            shown, counted = numbers.pretty_print(text), is_counted(claim, i, j)
            cell = cells[i][j] if cells else None
            differs = bool(counted and cell and against and _differs(against, i, j))
            pieces = numbers.mark(shown, numbers.write_like(cell, text)) if differs and cell else [(shown, False)]
            rows[-1].append(CellView(pieces, counted))
    return Panel("printed", None, rows)


def _found_panel(claim: Claim, finding: Finding) -> Panel:
    cells = fitting(claim, finding)
    rows: list[list[CellView]] = []
    agreeing = total = 0
    for i, row in enumerate(claim.rows or []):
        rows.append([])
        for j, text in enumerate(row):
            cell = cells[i][j] if cells else None
            counted = cell is not None and is_counted(claim, i, j)
            differs = counted and _differs(finding, i, j)
            agreeing, total = agreeing + (counted and not differs), total + counted
            entry = finding.entries.get((i + 1, j + 1), {})
            rows[-1].append(_cell_view(cell, text, counted, entry if differs else None))
    rows, place = _cropped(rows)
    return Panel(finding.name, finding, rows, place, agreeing, total)


def _cropped(rows: list[list[CellView]]) -> tuple[list[list[CellView]], str]:
    """Return the smallest block that holds all counted cells, and where it stands (empty for the whole)."""
    kept_rows = [i for i, row in enumerate(rows) if any(cell.counted for cell in row)]
    kept_columns = [j for j in range(max(map(len, rows))) if any(j < len(row) and row[j].counted for row in rows)]
    if not kept_rows or (len(kept_rows) == len(rows) and len(kept_columns) == max(map(len, rows))):
        return rows, ""
    (top, bottom), (left, right) = (kept_rows[0], kept_rows[-1]), (kept_columns[0], kept_columns[-1])
    block = [row[left : right + 1] for row in rows[top : bottom + 1]]
    return block, f"{_span('row', top, bottom)}, {_span('column', left, right)}"


def _span(name: str, first: int, last: int) -> str:
    return f"{name} {first + 1}" if first == last else f"{name}s {first + 1}-{last + 1}"


def is_counted(claim: Claim, i: int, j: int) -> bool:
    """Say whether the claim is about the printed cell in row i and column j (from zero)."""
    return claim.mask is None or claim.mask[i][j]


def _differs(finding: Finding, i: int, j: int) -> bool:
    entry = finding.entries.get((i + 1, j + 1), {} if finding.entries else finding.shown)
    return entry.get("agrees", "yes") != "yes"


def _cell_view(cell: numbers.Cell | None, text: str, counted: bool, differing: dict[str, Any] | None) -> CellView:
    if cell is None:
        return CellView([("·", False)], False)
    shown, printed = numbers.write_like(cell, text), numbers.pretty_print(text)
    if differing is None:
        return CellView([(printed if counted else shown, False)], counted)
    for extra in range(1, 6):
        if shown != printed:
            break
        shown = numbers.write_like(cell, text, extra)
    units = differing.get("units_in_last_place")
    words = f"{plain(float(units))} units of the last place from the print" if units else ""
    return CellView(numbers.mark(shown, printed), counted, words)


def found_text(claim: Claim, finding: Finding) -> str:
    """Return what a reading found in one line."""
    if finding.error:
        return finding.error.strip().splitlines()[0]
    if mixed(finding):
        return cases_text(finding)
    counted = compared(claim, finding)
    if len(counted) == 1:
        cell, text = counted[0]
        plainly = finding.strength == "exact" and numbers.distance(cell, numbers.write_like(cell, text)) == 0
        return numbers.write_like(cell, text, 0 if plainly else GUARD)
    if counted:
        measured = distances(finding)
        return f"{len(measured) - len(far(finding))} of {len(measured)} entries agree"
    return cases_text(finding) if finding.cases else values.one_line(finding.value)


def mixed(finding: Finding) -> bool:
    """Say whether cases of a reading disagree: one value would be that of a case which may not be the deciding one."""
    return len({case.get("agrees") for _, case in finding.cases}) > 1


def cases_text(finding: Finding) -> str:
    """Return how many cases of a reading agree."""
    yes = sum(case.get("agrees") == "yes" for _, case in finding.cases)
    return f"{yes} of {len(finding.cases)} cases agree"


def compared(claim: Claim, finding: Finding) -> list[tuple[numbers.Cell, str]]:
    """Return (found, printed) of the cells that the claim is about; none where the two shapes differ."""
    cells = fitting(claim, finding) or []
    pairs = [
        (cells[i][j], text)
        for i, row in enumerate(claim.rows or [] if cells else [])
        for j, text in enumerate(row)
        if is_counted(claim, i, j) and numbers.is_number(text)
    ]
    return [(cell, text) for cell, text in pairs if cell is not None]


def distance_text(finding: Finding) -> str:
    """Return the largest distance in units of the last printed place; empty where there is none."""
    given = finding.raw.get("units_in_last_place")
    return plain(float(given)) if isinstance(given, (int, float)) else ""


def digits_text(finding: Finding) -> str:
    """Return how many leading digits agree, of how many printed; for the compared cell with the fewest."""
    compared = [(e["digits"], e["digits_printed"]) for e in finding.entries.values() if e.get("digits_printed")]
    if compared:
        return "{} of {}".format(*min(compared))
    given = finding.raw.get("digits")
    return str(given) if isinstance(given, int) and given else ""


def difference_text(claim: Claim, finding: Finding) -> str:
    """Return the absolute and the relative difference of a single printed number; empty for matrices."""
    counted = compared(claim, finding)
    if len(counted) != 1:
        return ""
    cell, text = counted[0]
    model = numbers.parse_print(text)
    if model is None or cell.im is not None:
        return ""
    off = cell.re - model.value
    relative = f", relative {numbers.significant(off / model.value, 2)}" if model.value else ""
    return f"{numbers.significant(off, 2)}{relative}"


def correction(claim: Claim) -> str:
    """Return what should stand in place of an erratum in one line; empty where the finding is only that it differs."""
    finding = claim.decisive
    if claim.correct:
        return claim.correct
    if finding is None or finding.cases or claim.compare in ("identity", "membership"):
        return ""
    return found_text(claim, finding)


def case_finding(finding: Finding, case: dict[str, Any]) -> Finding:
    """Return one case of a reading as a finding of its own, to be shown by the same functions."""
    empty = {"value": None, "units_in_last_place": None, "digits": None, "error": None}
    return Finding({**finding.raw, **empty, "cases": None, "evidence": None, **case}, finding.entry)


def summary(claim: Claim) -> str:
    """Return one plain sentence that says why the verdict is what it is, from the findings alone."""
    decisive = claim.decisive
    name = f"“{decisive.name}”" if decisive else "none"
    tried = f"{len(claim.findings)} reading{'s' * (len(claim.findings) != 1)} tried"
    sentences = {
        "reproduced": f"The paper's own definition gives the print: reading {name}.",
        "reproduced-under-assumption": f"The paper leaves this open; the assumption {name} gives the print.",
        "certified": f"The published value satisfies the condition: {name}. Its digits are not unique and not judged.",
        "not-reproduced": f"{tried}, none gives the print.",
        "unspecified": f"Not given in the paper: {', '.join(claim.missing) or 'what is needed to compare'}.",
        "failed": "The computation did not come to an end; nothing follows about the paper.",
        "erratum": _erratum_sentence(claim),
    }
    return sentences.get(claim.verdict, "")


def _erratum_sentence(claim: Claim) -> str:
    definitions = [f"“{finding.name}”" for finding in claim.findings if finding.kind == "definition"]
    start = f"The paper's own definition, {', '.join(definitions)}, does not give the print"
    start = start if definitions else "No assumption gives the print"
    why = [f"“{finding.name}”" for finding in claim.explanations]
    return f"{start}; " + (f"the print is explained by {', '.join(why)}." if why else "no explanation was found.")
