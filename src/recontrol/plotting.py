"""One figure style for every paper, and a ``save`` whose bytes depend on the figure alone.

In: numbers. Out: a ``Figure`` made by :func:`subplots`, and the files that :func:`save` writes. The style is made for
a column of 88 mm: text of 6 to 7 points at that width, colours that stay apart for colour-blind readers and in grey,
and a line style tied to each colour so that a legend never rests on colour alone.
"""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

MM = 1 / 25.4  # inches
COLUMN = 88.0  # mm, one column of a two-column page
PAGE = 180.0  # mm, both columns

# Blue, rose and gold are Paul Tol's high-contrast scheme: their lightness is 28, 48 and 72, so they stay apart in grey.
# Black and teal come after them; five series are the most that one panel should carry.
BLUE, ROSE, GOLD, BLACK, TEAL = "#004488", "#bb5566", "#ddaa33", "#000000", "#44aa99"
GREY, PALE, FAINT = "#6b6b6b", "#bdbdbd", "#e8e8e8"


class Series(NamedTuple):
    """How one series is drawn; pass ``**series.line`` or ``**series.points`` to an Axes method."""

    color: str
    linestyle: Any
    marker: str

    @property
    def line(self) -> dict[str, Any]:
        """Arguments of `axes.plot` for a line."""
        return {"color": self.color, "linestyle": self.linestyle}

    @property
    def points(self) -> dict[str, Any]:
        """Filled markers with a thin white rim, so that neighbours stay countable."""
        return {
            "color": self.color, "marker": self.marker, "linestyle": "none",
            "markeredgecolor": "white", "markeredgewidth": 0.4,
        }  # fmt: skip


SERIES = (
    Series(BLUE, "-", "o"),
    Series(ROSE, (0, (4.5, 1.6)), "s"),
    Series(GOLD, (0, (6, 1.3, 1.2, 1.3)), "^"),
    Series(BLACK, (0, (1.2, 1.4)), "D"),
    Series(TEAL, (0, (9, 2)), "v"),
)

STYLE: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],  # shipped with matplotlib: the same glyphs on every machine
    "mathtext.fontset": "dejavusans",
    "font.size": 7.0,
    "axes.labelsize": 7.0,
    "axes.titlesize": 7.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlepad": 4.0,
    "xtick.labelsize": 6.2,
    "ytick.labelsize": 6.2,
    "legend.fontsize": 6.2,
    "figure.titlesize": 7.5,
    "axes.linewidth": 0.6,
    "axes.edgecolor": "#333333",
    "axes.labelcolor": "#111111",
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": FAINT,
    "grid.linewidth": 0.5,
    "axes.xmargin": 0.02,
    "axes.ymargin": 0.06,
    "xtick.color": "#333333",
    "ytick.color": "#333333",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5,
    "ytick.minor.size": 1.5,
    "xtick.major.pad": 2.0,
    "ytick.major.pad": 2.0,
    "axes.labelpad": 2.5,
    "lines.linewidth": 1.1,
    "lines.markersize": 4.0,
    "lines.dash_capstyle": "butt",
    "lines.scale_dashes": True,
    "patch.linewidth": 0.5,
    "hatch.linewidth": 0.4,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "legend.columnspacing": 1.4,
    "legend.handletextpad": 0.6,
    "legend.labelspacing": 0.3,
    "legend.borderaxespad": 0.3,
    "axes.formatter.use_mathtext": False,  # parsing each tick label as a formula doubles the time of a figure
    "axes.formatter.limits": (-3, 4),
    "axes.unicode_minus": True,
    "path.simplify": True,  # to a ninth of a pixel: a third of the size and same picture; the data are in the CSV
    "figure.dpi": 100,
    "savefig.dpi": 300,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "recontrol",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    "pdf.compression": 9,
    "figure.constrained_layout.h_pad": 0.03,
    "figure.constrained_layout.w_pad": 0.03,
}

# Dates and versions would make two equal figures differ.
_METADATA: dict[str, dict[str, Any]] = {
    "svg": {"Date": None},
    "pdf": {"CreationDate": None, "ModDate": None, "Creator": None, "Producer": None},
    "png": {"Software": None},
}


def use_style() -> None:
    """Make :data:`STYLE` the style of this process; :func:`subplots` does it for you."""
    import matplotlib

    matplotlib.rcParams.update(STYLE)


def subplots(rows: int = 1, columns: int = 1, *, width: float = COLUMN, height: float = 60.0, **options: Any) -> Any:
    """A figure of `width` x `height` millimetres and its axes.

    Parameters
    ----------
    rows, columns : int
        The grid. The axes come back as ``Figure.subplots`` gives them: one Axes, or an array of them.
    width, height : float
        Size of the whole picture [mm]; :data:`COLUMN` or :data:`PAGE` wide.
    **options
        Passed to ``Figure.subplots`` (``sharex``, ``width_ratios``, ``squeeze``, ...).

    Returns
    -------
    (Figure, Axes or ndarray of Axes)
        The figure belongs to no window and to no pyplot state; the layout is constrained, labels do not collide.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    use_style()
    fig = Figure(figsize=(width * MM, height * MM), layout="constrained")
    FigureCanvasAgg(fig)
    return fig, fig.subplots(rows, columns, **options)


def axis_label(quantity: str, unit: str) -> str:
    """``quantity (unit)``; the unit "1" of a dimensionless quantity is shown as a dash.

    Raises
    ------
    ValueError
        If the unit is empty: an axis without a unit says nothing, "1" says that there is none.
    """
    if not unit.strip():
        raise ValueError(f"axis {quantity!r} has no unit: give one, or '1' for a dimensionless quantity")
    return f"{quantity} ({'–' if unit == '1' else unit})"


def label_axes(ax: Any, x: tuple[str, str] | None = None, y: tuple[str, str] | None = None) -> None:
    """Label the axes by (quantity, unit); None leaves an axis as it is (shared axes)."""
    if x is not None:
        ax.set_xlabel(axis_label(*x))
    if y is not None:
        ax.set_ylabel(axis_label(*y))


def put_factor_into_label(ax: Any) -> None:
    """Move the power of ten that the ticks of x share into their label: in the corner a long label meets it."""
    formatter = ax.xaxis.get_major_formatter()
    formatter.set_useMathText(True)
    formatter.set_locs(ax.get_xticks())
    if factor := formatter.get_offset():
        ax.xaxis.get_offset_text().set_visible(False)
        ax.set_xlabel(f"{ax.get_xlabel()} {factor}")


def letter_panels(axes: Iterable[Any], titles: Sequence[str] | None = None) -> None:
    """Put (a), (b), ... and an optional short title above each panel, left-aligned."""
    for k, ax in enumerate(np.ravel(np.asarray(axes, dtype=object))):
        title = f"({chr(ord('a') + k)})"
        ax.set_title(title if titles is None else f"{title} {titles[k]}")


def band(ax: Any, low: float, high: float, label: str | None = None, *, vertical: bool = False) -> Any:
    """Shade a tolerance band behind the curves (horizontal, or an interval of x if `vertical`)."""
    span = ax.axvspan if vertical else ax.axhspan
    return span(low, high, facecolor=FAINT, edgecolor="none", zorder=0.5, label=label)


def legend_below(fig: Any, axes: Any, *, columns: int = 3) -> Any:
    """One legend under all panels, each label once, in the order of first appearance."""
    entries: dict[str, Any] = {}
    for ax in np.ravel(np.asarray(axes, dtype=object)):
        for handle, text in zip(*ax.get_legend_handles_labels(), strict=True):
            entries.setdefault(text, handle)
    return fig.legend(list(entries.values()), list(entries), loc="outside lower center", ncols=columns)


def save(fig: Any, stem: str | Path, formats: Sequence[str] = ("svg", "pdf", "png")) -> list[Path]:
    """Write ``stem.svg``, ``stem.pdf`` and ``stem.png``; equal figures give equal bytes.

    Parameters
    ----------
    fig : matplotlib.figure.Figure
    stem : path without extension; a dot in the name is kept. The directory must exist.
    formats : names out of svg, pdf, png

    Returns
    -------
    list of Path
        The files written, in the order of `formats`.

    Raises
    ------
    ValueError
        If a format is unknown (its date could not be taken out).
    """
    import matplotlib

    unknown = [name for name in formats if name not in _METADATA]
    if unknown:
        raise ValueError(f"unknown figure format {unknown}: expected some of {sorted(_METADATA)}")
    paths = []
    with matplotlib.rc_context(STYLE):
        engine = fig.get_layout_engine()
        if engine is not None:  # one layout for all formats, computed once
            engine.execute(fig)
            fig.set_layout_engine("none")
        for name in formats:
            path = Path(f"{stem}.{name}")
            fig.savefig(path, format=name, metadata=_METADATA[name])
            paths.append(path)
    return paths


def extent(values: Any) -> float:
    """Range of the values; their largest magnitude if they are all but equal (a single point, a constant)."""
    array = np.asarray(values, dtype=float)
    spread, size = float(np.ptp(array)), float(np.max(np.abs(array)))
    return max(spread if spread > 1e-9 * size else size, 1e-300)


def drift_picture(reference: Mapping[str, Any], found: Mapping[str, Any], title: str) -> Any:
    """Both versions of the curves of a figure that differ, worst first, and their difference.

    Parameters
    ----------
    reference, found : mapping label -> (x, y), arrays of equal length
        Curves are matched by label; a curve that only one side has comes first and is named as such.
    title : what stands above the picture

    Notes
    -----
    The difference of a curve is taken on the x of the reference; for points in no order of x, it is the distance of
    each reference point to the nearest one found.
    """
    drifts = {label: _drift(reference.get(label), found.get(label)) for label in {**reference, **found}}
    worst = sorted(drifts, key=lambda label: -drifts[label].size)
    shown = [label for label in worst if drifts[label].size > 1e-9][:ROWS] or worst[:1]
    fig, axes = subplots(len(shown), 2, width=PAGE, height=18 + 36 * len(shown), squeeze=False)
    fig.suptitle(f"{title}: {sum(d.size > 1e-9 for d in drifts.values())} of {len(drifts)} curves differ")
    for (curves, difference), label in zip(axes, shown, strict=True):
        for k, (name, side) in enumerate((("reference", reference), ("found", found))):
            if label in side:
                dense = np.size(side[label][0]) > 2
                curves.plot(*side[label], label=name, **(SERIES[k].line if dense else SERIES[k].points))
        curves.set_title(label)
        curves.legend()
        drift = drifts[label]
        difference.plot(drift.x, drift.y, color=BLACK, marker="." if drift.x.size < 3 else "none")
        difference.set_title(drift.words)
    return fig


ROWS = 8  # of a drift picture


class _Drift(NamedTuple):
    """Difference of one curve over x, its size over the range of the reference, and what the panel shows."""

    x: Any
    y: Any
    size: float
    words: str


def _drift(reference: Any, found: Any) -> _Drift:
    if reference is None or found is None:
        return _Drift(np.array([]), np.array([]), np.inf, "only on one side")
    (x, y), (x_new, y_new) = (np.asarray(side, dtype=float) for side in (reference, found))
    scale_x, scale_y = extent(x), extent(y)
    if np.all(np.diff(x) > 0) and np.all(np.diff(x_new) > 0) and x.size > 1:
        gap = np.interp(x, x_new, y_new) - y
        return _Drift(x, gap, float(np.max(np.abs(gap))) / scale_y, "found minus reference")
    apart = np.hypot((x[:, None] - x_new) / scale_x, (y[:, None] - y_new) / scale_y).min(axis=1)
    return _Drift(np.arange(x.size), apart, float(apart.max()), "distance to the nearest point, over the range")
