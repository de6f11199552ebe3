"""The figure style: deterministic bytes, series that stay apart, honest axis labels."""

import numpy as np
import pytest

from recontrol import plotting


def draw():
    fig, axes = plotting.subplots(1, 2, height=45)
    x = np.linspace(0, 10, 50)
    for ax in axes:
        for k, series in enumerate(plotting.SERIES[:3]):
            ax.plot(x, np.exp(-x / (k + 1)), label=f"curve {k}", **series.line)
        plotting.band(ax, -0.02, 0.02, "2 % band")
        plotting.label_axes(ax, ("time", "s"), ("output $y$", "1"))
    plotting.letter_panels(axes, ["first", "second"])
    plotting.legend_below(fig, axes, columns=4)
    return fig


def rgb(colour):
    return np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255


def linear(channels):
    return np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)


def lightness(colour):
    """CIE L* from the relative luminance of the sRGB colour."""
    y = float(np.dot([0.2126, 0.7152, 0.0722], linear(rgb(colour))))
    return 116 * np.cbrt(y) - 16 if y > 0.008856 else 903.3 * y


def test_equal_figures_give_equal_bytes(tmp_path):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        plotting.save(draw(), tmp_path / name / "figure")
    for suffix in ("svg", "pdf", "png"):
        first, second = ((tmp_path / n / f"figure.{suffix}").read_bytes() for n in ("one", "two"))
        assert first == second
        assert not any(word in first for word in (b"<dc:date>", b"CreationDate", b"tIME"))


def test_save_keeps_dots_and_order(tmp_path):
    paths = plotting.save(draw(), tmp_path / "gain-0.5", formats=("png", "svg"))
    assert [p.name for p in paths] == ["gain-0.5.png", "gain-0.5.svg"]


def test_save_refuses_a_format_whose_date_it_does_not_know(tmp_path):
    with pytest.raises(ValueError, match="eps"):
        plotting.save(draw(), tmp_path / "f", formats=("eps",))


def test_png_is_as_wide_as_a_column(tmp_path):
    (path,) = plotting.save(draw(), tmp_path / "f", formats=("png",))
    width = int.from_bytes(path.read_bytes()[16:20], "big")  # IHDR
    assert width == pytest.approx(88 / 25.4 * 300, abs=1)


def test_first_four_series_stay_apart_in_grey():
    grey = sorted(lightness(s.color) for s in plotting.SERIES[:4])
    assert min(np.diff(grey)) > 15  # a step of 10 in L* is seen at a glance between neighbouring lines


# Full loss of the red, green or blue cones (Machado, Oliveira, Fernandes 2009, table 1, severity 1).
DICHROMATS = {
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}


@pytest.mark.parametrize("kind", DICHROMATS)
def test_series_stay_apart_for_colour_blind_readers(kind):
    seen = [np.clip(np.array(DICHROMATS[kind]) @ linear(rgb(s.color)), 0, 1) for s in plotting.SERIES]
    gaps = [np.linalg.norm(np.cbrt(a) - np.cbrt(b)) for i, a in enumerate(seen) for b in seen[:i]]
    assert min(gaps) > 0.12  # cube roots are roughly perceptual; the clash of pure red and green under deutan is 0.1


def test_line_styles_and_markers_differ():
    assert len({str(s.linestyle) for s in plotting.SERIES}) == len(plotting.SERIES)
    assert len({s.marker for s in plotting.SERIES}) == len(plotting.SERIES)


def test_axis_label_wants_a_unit():
    assert plotting.axis_label("time", "s") == "time (s)"
    assert plotting.axis_label("output", "1") == "output (–)"
    with pytest.raises(ValueError, match="no unit"):
        plotting.axis_label("output", "")


def test_legend_names_each_curve_once():
    legend = draw().legends[0]
    assert [t.get_text() for t in legend.get_texts()] == ["curve 0", "curve 1", "curve 2", "2 % band"]


def test_drift_picture_shows_what_differs_worst_first():
    x = np.linspace(0, 1, 5)
    reference = {"same": (x, x), "little": (x, x), "much": (x, x), "gone": (x, x)}
    found = {"same": (x, x), "little": (x, x + 0.01), "much": (x, x + 1), "new": (x, x)}
    fig = plotting.drift_picture(reference, found, "drift")
    titles = [ax.get_title("left") for ax in fig.axes]
    assert sorted(titles[:4:2]) == ["gone", "new"]
    assert titles[4::2] == ["much", "little"]
    assert fig.get_suptitle() == "drift: 4 of 5 curves differ"
    np.testing.assert_allclose(fig.axes[5].lines[0].get_ydata(), 1.0, rtol=0, atol=1e-15)


def test_drift_of_unordered_points_is_the_distance_to_the_nearest():
    points = (np.array([0.0, 2.0, 1.0]), np.array([0.0, 1.0, 1.0]))
    moved = (np.array([1.0, 0.0, 2.0]), np.array([1.0, 0.0, 0.5]))  # another order, one point lower by half the range
    fig = plotting.drift_picture({"p": points}, {"p": moved}, "drift")
    np.testing.assert_allclose(fig.axes[1].lines[0].get_ydata(), [0.0, 0.5, 0.0], atol=1e-15)
