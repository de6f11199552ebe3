"""One paper folder: identity, data, cases, stages, quantities and figures, read from paper.yaml and validated."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StringConstraints, ValidationError, field_validator, model_validator

from recontrol import yamltext
from recontrol.errors import PaperError, UnknownNameError

if TYPE_CHECKING:
    from recontrol.claims.printed import Printed

Key = Annotated[str, StringConstraints(pattern=r"^[a-z]+[0-9]{4}[a-z]?$")]
Name = Annotated[str, StringConstraints(pattern=r"^[A-Za-z][A-Za-z0-9_.=+-]{0,79}$")]
Text = Annotated[str, StringConstraints(min_length=1, max_length=20_000)]
STAGES_WITH_PARTS = ("synthesis", "certificates", "simulation")


class Strict(BaseModel):
    """Base of every file model: unknown keys are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Datum(Strict):
    """One printed number or matrix of the paper, kept as text."""

    printed: Text
    unit: str
    where: Text
    what: Text
    exact: bool = False
    source: str = ""


class Variant(Strict):
    """A datum with single entries replaced."""

    of: Name
    patch: dict[str, str] = Field(min_length=1)
    why: Text


class Case(Strict):
    """A named way to fill what the paper leaves open."""

    what: Text


class Quantity(Strict):
    """A computed number beyond the claims: unit and meaning."""

    unit: str
    what: Text


Tolerance = Annotated[str, StringConstraints(pattern=r"^\d(\.\d+)?e-\d+$")]


class FigureEntry(Strict):
    """One figure of the folder: `of` is `paper` (a redrawn one) or `finding`.

    A curve may drift from its reviewed reference by `tolerance` of its range; `looser` names curves with another one.
    """

    title: Text
    caption: Text
    of: Annotated[str, StringConstraints(pattern="^(paper|finding)$")] = "finding"
    tolerance: Tolerance = "1e-4"
    looser: dict[str, Tolerance] = {}


class Outcome(Strict):
    """One outcome of a campaign's trajectories; `worst` says which end is the bad one."""

    unit: str
    what: Text
    worst: Annotated[str, StringConstraints(pattern="^(max|min)$")] = "max"


class Campaign(Strict):
    """An ensemble over an uncertainty that the paper itself states."""

    what: Text
    seed: Annotated[int, Field(ge=0)]
    outcomes: dict[Name, Outcome] = Field(min_length=1)


class Bibtex(BaseModel):
    """BibTeX entry: type, key and further fields as text."""

    model_config = ConfigDict(extra="allow", frozen=True)
    type: Text
    key: Text


class PaperFile(Strict):
    """The model of paper.yaml."""

    key: Key
    title: Text
    authors: list[Text] = Field(min_length=1)
    year: Annotated[int, Field(ge=1900, le=2100)]
    venue: Text
    doi: Annotated[str, StringConstraints(pattern=r"^(10\.\d{4,9}/\S+)?$")] | None = ""
    bibtex: Bibtex
    about: Text
    use: Text
    data: dict[Name, Datum] = Field(min_length=1)
    variants: dict[Name, Variant] = {}
    cases: dict[Name, Case] = {}
    stages: dict[str, dict[Name, Text]] = {}
    quantities: dict[Name, Quantity] = {}
    figures: dict[Name, FigureEntry] = {}
    campaigns: dict[Name, Campaign] = {}

    @field_validator("stages")
    @classmethod
    def _known_stages(cls, value: dict[str, Any]) -> dict[str, Any]:
        unknown = sorted(set(value) - set(STAGES_WITH_PARTS))
        if unknown:
            raise ValueError(f"unknown stage {unknown[0]!r}; stages with parts are {', '.join(STAGES_WITH_PARTS)}")
        return value

    @model_validator(mode="after")
    def _printed_data(self) -> PaperFile:
        from recontrol.claims.printed import Printed

        parsed = {}
        for name, datum in self.data.items():
            try:
                parsed[name] = Printed.parse(datum.printed, exact=datum.exact)
            except PaperError as error:
                raise ValueError(f"data.{name}: {error}") from None
        for name, variant in self.variants.items():
            if name in parsed:
                raise ValueError(f"variants.{name}: the name is taken by a datum")
            if variant.of not in self.data:
                raise ValueError(f"variants.{name}: {variant.of!r} is not a name under data")
            try:
                parsed[variant.of].patched(variant.patch)
            except PaperError as error:
                raise ValueError(f"variants.{name}: {error}") from None
        return self


def validate(
    model: type[Strict], content: Any, lines: yamltext.Lines, path: Path, prefix: tuple = (), owner: str = ""
) -> Any:
    """Validate parsed YAML; raises PaperError that names file, line, key path, and what was expected and found.

    prefix: where the content stands in the file; owner: what the message calls that place instead.
    """
    try:
        return model.model_validate(content)
    except ValidationError as error:
        messages = []
        for item in error.errors()[:8]:
            place = tuple(item["loc"])
            steps = ".".join(str(step) for step in (place if owner else (*prefix, *place)))
            key_path = ": ".join(part for part in (owner, steps) if part) or "(top level)"
            found = "" if item["type"] in ("missing", "extra_forbidden") else f"; found {_short(item.get('input'))}"
            hint = (
                "; a comma inside {...} ends a value: quote it"
                if item["type"] == "extra_forbidden" and " " in str(place[-1])
                else ""
            )
            messages.append(f"{path}:{lines.nearest((*prefix, *place))}: {key_path}: {item['msg']}{found}{hint}")
        raise PaperError("\n".join(messages)) from None


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


class Data:
    """The printed data of a paper under their names (variants included).

    `data[name]` is exact: fmpq for a single number, else an object array (rows, columns) of fmpq.
    """

    def __init__(self, printed: dict[str, Printed], entries: dict[str, Datum], path: Path):
        self._printed, self._entries, self._path = printed, entries, path

    def printed(self, name: str) -> Printed:
        """The Printed object. Raises UnknownNameError."""
        if name not in self._printed:
            raise UnknownNameError(f"{self._path}: no datum named {name!r}; names: {', '.join(sorted(self._printed))}")
        return self._printed[name]

    def __contains__(self, name: object) -> bool:
        return name in self._printed

    def names(self) -> list[str]:
        """All names, variants included."""
        return list(self._printed)

    def __getitem__(self, name: str) -> Any:
        printed = self.printed(name)
        return printed.values[0, 0] if printed.is_scalar else printed.values.copy()

    def half(self, name: str) -> Any:
        """Half units of the last printed places, fmpq or object array; zero for exact data."""
        printed = self.printed(name)
        return printed.halves[0, 0] if printed.is_scalar else printed.halves.copy()

    def float(self, name: str) -> Any:
        """Nearest double or float array; complex cells give complex numbers (the member with the printed sign)."""
        import numpy as np

        printed = self.printed(name)
        if printed.is_complex:
            array = np.array(
                [
                    [complex(float(c.real.value), float(c.imag.value) if c.imag else 0.0) for c in r]
                    for r in printed.rows
                ]
            )
        else:
            array = np.array([[float(c.real.value) for c in row] for row in printed.rows])
        return array[0, 0].item() if printed.is_scalar else array

    def ball(self, name: str) -> Any:
        """The rounding box as arb or object array of arb (radius = half unit, zero for exact data)."""
        import numpy as np
        from flint import arb

        printed = self.printed(name)
        balls = np.empty(printed.shape, dtype=object)
        for place in np.ndindex(printed.shape):
            half = printed.halves[place]
            balls[place] = (
                arb(printed.values[place]) + arb(0, arb(half).abs_upper()) if half else arb(printed.values[place])
            )
        return balls[0, 0] if printed.is_scalar else balls

    def text(self, name: str) -> str:
        """The text as printed, rows joined by newlines."""
        return "\n".join(" ".join(cell.text for cell in row) for row in self.printed(name).rows)

    def unit(self, name: str) -> str:
        """The unit as paper.yaml gives it; a variant has that of its datum. Raises UnknownNameError."""
        return self.entry(name).unit

    def entry(self, name: str) -> Datum:
        """The entry of paper.yaml: a variant has that of its datum. Raises UnknownNameError."""
        self.printed(name)
        return self._entries[name]


class Paper:
    """A validated paper folder."""

    def __init__(self, folder: Path, file: PaperFile):
        self.folder, self.file = folder, file

    @property
    def key(self) -> str:
        """The folder's name."""
        return self.file.key

    @cached_property
    def data(self) -> Data:
        """The printed data, parsed once."""
        from recontrol.claims.printed import Printed

        printed = {name: Printed.parse(d.printed, exact=d.exact) for name, d in self.file.data.items()}
        entries = dict(self.file.data)
        for name, variant in self.file.variants.items():
            printed[name] = printed[variant.of].patched(variant.patch)
            entries[name] = entries[variant.of]
        return Data(printed, entries, self.folder / "paper.yaml")

    def parts(self, stage: str) -> list[str]:
        """Names of the parts of a stage, in the order of paper.yaml."""
        return list(self.file.stages.get(stage, {}))


def load(folder: Path | str) -> Paper:
    """Load and validate papers/<key>. Raises PaperError naming the file and line."""
    folder = Path(folder)
    path = folder / "paper.yaml"
    if not folder.is_dir():
        raise PaperError(f"{folder}: no such paper folder; `recontrol list` shows the papers")
    content, lines = yamltext.load(path)
    file = validate(PaperFile, content, lines, path)
    if file.key != folder.name:
        raise PaperError(
            f"{path}:{lines.nearest(('key',))}: key is {file.key!r}, but the folder is named {folder.name!r}"
        )
    return Paper(folder, file)


def discover(root: Path | str = ".") -> list[str]:
    """Keys of all folders under papers/ that hold a paper.yaml, sorted."""
    return sorted(path.parent.name for path in Path(root, "papers").glob("*/paper.yaml"))
