"""The model of claims.yaml and its validation against paper.yaml."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, StringConstraints, TypeAdapter, model_validator

from recontrol import yamltext
from recontrol.claims.printed import Printed, parse_mask
from recontrol.errors import PaperError
from recontrol.paper import Name, Paper, Strict, Text, validate

Compare = Literal["digits", "cut", "identity", "size", "statement", "bound", "range", "membership", "none"]
Kind = Literal["definition", "assumption", "explanation"]
VerdictName = Literal[
    "failed",
    "unspecified",
    "reproduced",
    "reproduced-under-assumption",
    "certified",
    "erratum",
    "not-reproduced",
]
ClaimId = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,79}$")]
Decimal = Annotated[str, StringConstraints(pattern=r"^[+-]?\d+(\.\d+)?(e[+-]?\d{1,3})?$")]
NUMERIC = ("digits", "cut", "bound")


class Over(Strict):
    """Named cases of a reading; it holds in `all` or in `any` of them."""

    cases: list[Name] = Field(min_length=1)
    holds: Literal["all", "any"] = "all"


class Reading(Strict):
    """One exact way to compute what a claim prints."""

    name: Text
    kind: Kind
    function: Annotated[str, StringConstraints(pattern=r"^[A-Za-z_]\w*(\.[A-Za-z_]\w*)?$")]
    over: Over | None = None
    note: Name | None = None
    compare: Compare | None = None
    certificate: Name | None = None


class Expected(Strict):
    """The reviewed verdict."""

    verdict: VerdictName
    explained_by: str | None = None


class Claim(Strict):
    """One thing the paper prints."""

    id: ClaimId
    where: Text
    title: Text
    compare: Compare
    printed: Text | None = None
    data: Name | None = None
    exact: bool = False
    entries: str | None = None
    except_: str | None = Field(default=None, alias="except")
    unit: str = ""
    unique: bool = True
    origin: Literal["print", "print-or-ocr"] = "print"
    bound: Literal["<=", ">="] | None = None
    range: tuple[Decimal, Decimal] | None = None
    readings: list[Reading] = []
    expected: Expected
    missing: list[Text] = []
    notes: list[Name] = []
    because: Text

    @model_validator(mode="after")
    def _consistent(self) -> Claim:
        if (self.printed is None) == (self.data is None):
            raise ValueError("give exactly one of 'printed' and 'data'")
        if not self.readings and self.compare != "none":
            raise ValueError("a claim needs at least one reading (or compare: none with the missing items)")
        if self.compare == "none" and not self.missing:
            raise ValueError("compare: none needs 'missing', the list of what the paper does not give")
        for option, how in (("bound", "bound"), ("range", "range")):
            used = {self.compare, *(reading.compare for reading in self.readings)}
            if (getattr(self, option) is not None) != (how in used):
                raise ValueError(f"'{option}' goes with compare: {how}, and only with it")
        names = [reading.name for reading in self.readings]
        if len(set(names)) < len(names):
            raise ValueError("two readings have the same name")
        explained = self.expected.explained_by
        explanations = [reading.name for reading in self.readings if reading.kind == "explanation"]
        if explained and explained not in explanations:
            raise ValueError(f"expected.explained_by: {explained!r} is not the name of an explanation reading")
        for reading in self.readings:
            if reading.kind == "assumption" and not (reading.note or self.notes):
                raise ValueError(f"reading {reading.name!r} is an assumption: cite the note that names it")
        return self

    def printed_value(self, paper: Paper) -> Printed:
        """The printed numbers. Raises PaperError if the text is not numeric."""
        if self.data is not None:
            return paper.data.printed(self.data)
        return Printed.parse(self.printed or "", exact=self.exact)

    def printed_text(self, paper: Paper) -> str:
        """What the report shows as printed."""
        return paper.data.text(self.data) if self.data is not None else (self.printed or "").strip()


def load(paper: Paper) -> list[Claim]:
    """Read and validate claims.yaml against its paper.

    Raises PaperError naming file, line and key path: unknown keys, duplicate ids, names of data, cases, certificates
    or notes that do not exist, masks that do not fit, printed text that is not numeric where numbers are compared.
    """
    path = paper.folder / "claims.yaml"
    content, lines = yamltext.load(path)
    if not isinstance(content, list) or not content:
        raise PaperError(f"{path}: expected a list of claims; zero claims prove nothing")
    claims: list[Claim] = []
    for index, item in enumerate(content):
        claims.append(validate(Claim, item, lines, path, prefix=(index,), owner=_owner(item, index)))
    seen: dict[str, int] = {}
    notes = note_ids(paper.folder)
    for index, claim in enumerate(claims):
        where = f"{path}:{lines.nearest((index,))}: claim {claim.id}"
        if claim.id in seen:
            raise PaperError(f"{where}: the id stands twice (first at line {seen[claim.id]})")
        seen[claim.id] = lines.nearest((index,))
        try:
            _cross_check(claim, paper, notes)
        except PaperError as error:
            raise PaperError(f"{where}: {error}") from None
    return claims


def _owner(item: Any, index: int) -> str:
    """What a message calls a claim that did not validate: its id, or its place in the file if it has none."""
    name = item.get("id") if isinstance(item, dict) else None
    return f"claim {name}" if isinstance(name, str) and name else f"claim number {index + 1}"


def _cross_check(claim: Claim, paper: Paper, notes: set[str]) -> None:
    if claim.data is not None and claim.data not in paper.data:
        raise PaperError(f"data {claim.data!r} is not a name under data or variants of paper.yaml")
    used = {claim.compare, *(reading.compare for reading in claim.readings)}
    if used & set(NUMERIC):
        printed = claim.printed_value(paper)
        parse_mask(claim.entries, claim.except_, printed.shape)
    for note in [*claim.notes, *(reading.note for reading in claim.readings if reading.note)]:
        if note not in notes:
            raise PaperError(f"note {note!r} has no heading '## {note}' in NOTES.md")
    for reading in claim.readings:
        for case in reading.over.cases if reading.over else []:
            if case not in paper.file.cases:
                raise PaperError(f"case {case!r} of reading {reading.name!r} is not under cases of paper.yaml")
        if reading.certificate and reading.certificate not in paper.parts("certificates"):
            raise PaperError(f"certificate {reading.certificate!r} is not under stages.certificates of paper.yaml")


def note_ids(folder: Path) -> set[str]:
    """Ids of the `## id` headings of NOTES.md. Raises PaperError if the file is missing."""
    path = folder / "NOTES.md"
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise PaperError(f"{path}: cannot be read ({error.strerror}); every paper folder needs this file") from None
    return {line[3:].strip() for line in text.splitlines() if line.startswith("## ")}


def json_schema() -> dict[str, Any]:
    """JSON Schema of claims.yaml for editors."""
    return TypeAdapter(list[Claim]).json_schema(by_alias=True)
