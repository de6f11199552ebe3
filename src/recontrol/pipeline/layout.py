"""Where artifacts lie. Everything below results/ and figures/ is made by the chain."""

from __future__ import annotations

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


def chunk_file(key: str, campaign: str, chunk: int) -> Path:
    """Sketches of one chunk of a campaign."""
    return Path("results", key, "ensemble", campaign, f"chunk-{chunk:05d}.json")


def distribution_file(key: str, campaign: str, target: str, suffix: str = "json") -> Path:
    """Merged distributions, or their picture: target `ensemble` (every run) or `campaign` (the large one)."""
    return Path("results", key, target, f"{campaign}.{suffix}")


def reference_file(folder: Path, figure: str) -> Path:
    """Reviewed, decimated data of a figure inside the paper folder."""
    return folder / "reference" / f"{figure}.csv"


def conclusions(key: str) -> list[Path]:
    """What is concluded from the stages of a paper: none of it may outlive a stage that runs again and fails."""
    return [*(artifact(key, name) for name in ("verdicts", "quantities", "review")), Path("results/verdicts.json")]
