"""The cost table: its problems are enclosed, its rows and page are written. Times are shown there, never tested."""

import pytest

from recontrol.lmi import bench


@pytest.mark.parametrize("n", [3, 12])
def test_both_bounds_are_proven_closely(n):
    cost = bench.measure(n)
    assert cost.width is not None
    assert cost.width < 1e-5


def test_the_largest_routine_size_is_enclosed():
    cost = bench.measure(24)
    assert (cost.order, cost.unknowns) == (26, 301)
    assert cost.width is not None
    assert cost.width < 1e-4


def test_the_table_has_a_row_for_each_size(capsys):
    assert bench.main(["--sizes", "2", "3"]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("| states |")
    assert [line.split("|")[1].strip() for line in printed[2:]] == ["2", "3"]


def test_page_and_plot_are_written_between_the_marks(tmp_path):
    page = tmp_path / "lmi.md"
    page.write_text(f"before\n{bench.BEGIN}\nold\n{bench.END}\nafter\n")
    assert bench.main(["--sizes", "2", "--write", str(tmp_path)]) == 0
    text = page.read_text()
    assert text.startswith("before")
    assert text.endswith("after\n")
    assert "old" not in text
    assert "| 2 | 4 |" in text
    assert (tmp_path / "lmi-cost.svg").stat().st_size > 1000
