"""Where artifacts lie. Everything below results/ and figures/ is made by the chain."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

FIGURE_FORMATS = ("svg", "pdf", "png", "csv")


def artifact(key: str, stage: str, part: str | None = None) -> Path:
    """JSON artifact of a stage, or of one of its parts."""
    return Path("results", key, f"{stage}.json") if part is None else Path("results", key, stage, f"{part}.json")


def series_file(key: str, part: str) -> Path:
    """Time series of a simulation part."""
    return Path("results", key, "simulation", f"{part}.npz")


def figure_file(key: str, figure: str, suffix: str) -> Path:
    """One format of a figure; `csv` holds the plotted data."""
    return Path("figures", key, f"{figure}.{suffix}")


def basis_file(key: str) -> Path:
    """Digests of everything that the ensembles of a paper depend on."""
    return Path("results", key, "ensemble-basis.json")


def chunks_file(key: str, campaign: str, first: int, last: int) -> Path:
    """Merged sketches of the chunks `first` to `last` of a campaign."""
    return Path("results", key, "ensemble", campaign, f"chunks-{first:06d}-{last:06d}.json")


def chunk_ranges(count: int, batch: int, small: int) -> list[tuple[int, int]]:
    """The first `count` chunks as the ranges (first, last) that one job each simulates.

    Cut at multiples of `batch`, and behind the `small` ones of every run, so that a larger campaign uses what is there.
    """
    cuts = sorted({0, count, *(k for k in (small, *range(0, count, batch)) if k < count)})
    return [(first, after - 1) for first, after in pairwise(cuts)]


def distribution_file(key: str, campaign: str, target: str, suffix: str = "json") -> Path:
    """Merged distributions, or their picture: target `ensemble` (every run) or `campaign` (the large one)."""
    return Path("results", key, target, f"{campaign}.{suffix}")


def reference_file(folder: Path, figure: str) -> Path:
    """Reviewed, decimated data of a figure inside the paper folder."""
    return folder / "reference" / f"{figure}.csv"


def conclusions(key: str) -> list[Path]:
    """What is concluded from the stages of a paper: none of it may outlive a stage that runs again and fails."""
    return [*(artifact(key, name) for name in ("verdicts", "quantities", "review")), Path("results/verdicts.json")]
