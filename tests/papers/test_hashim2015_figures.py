"""hashim2015, figures: what each draws, and that the digit map says what the arithmetic says."""

import numpy as np
import pytest

from papers.hashim2015.figures.published import ace, origin_of
from recontrol import paper
from recontrol.pipeline import inputs
from tests.conftest import ROOT
from tests.papers.hashim2015_artifacts import DATA, MODEL, SYNTHESIS, call, simulated

NAMES = list(paper.load(ROOT / "papers/hashim2015").file.figures)


@pytest.mark.parametrize("name", NAMES)
def test_every_figure_is_drawn_at_column_width_with_units(name):
    fig, curves = call(inputs.function_of("hashim2015", "figures", name), simulation=simulated())
    assert fig.get_size_inches()[0] == pytest.approx(88 / 25.4)
    labels = [text for ax in fig.axes for text in (ax.get_xlabel(), ax.get_ylabel()) if text]
    assert labels
    assert all(text.endswith(")") and "(" in text for text in labels)
    for x, y in curves.values():
        assert x.shape == y.shape
        assert x.size
        assert np.all(np.isfinite(x) & np.isfinite(y))
    used = {float(t.get_fontsize()) for t in fig.findobj(lambda a: hasattr(a, "get_fontsize")) if t.get_text()}
    assert min(used) >= 5  # points at 88 mm


def test_digit_map_of_55_by_exact_rationals():
    """Eight cells follow from A_c in place of A; (1,6) and (6,5) from neither; all else from the derivation."""
    _, curves = ace(DATA, MODEL, SYNTHESIS)
    cells = {name: set(zip(x.astype(int), y.astype(int), strict=True)) for name, (x, y) in curves.items()}
    assert cells["neither"] == {(6, 1), (5, 6)}  # (column, row)
    assert cells["A_c for A"] == {(c, 1) for c in (1, 2, 3, 4)} | {(c, 5) for c in (5, 6, 7, 8)}
    assert sum(map(len, cells.values())) == 64


def test_origin_takes_the_first_candidate_that_rounds():
    printed, half = np.array([[0.5, 0.5, 0.5]]), np.full((1, 3), 0.05)
    candidates = {"first": np.array([[0.54, 0.7, 0.7]]), "second": np.array([[0.5, 0.46, 0.7]])}
    assert origin_of(printed, half, candidates).tolist() == [["first", "second", "neither"]]
