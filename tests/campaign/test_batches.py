"""How a campaign is cut into jobs, what its progress says, and when a large one is out of date."""

from __future__ import annotations

import json

import pytest

from recontrol.pipeline import standing
from recontrol.pipeline.layout import chunk_ranges, chunks_file, distribution_file
from recontrol.pipeline.progress import progress
from recontrol.pipeline.store import record_path


@pytest.mark.parametrize(("count", "batch", "small"), [(100, 20, 1), (5, 2, 1), (7, 3, 4), (1, 20, 1), (3, 20, 5)])
def test_ranges_hold_every_chunk_once(count, batch, small):
    ranges = chunk_ranges(count, batch, small)
    assert [k for first, last in ranges for k in range(first, last + 1)] == list(range(count))
    assert all(last - first < batch for first, last in ranges)


def test_a_larger_campaign_keeps_the_jobs_of_a_smaller_one_and_of_every_run():
    small, medium, large = (set(chunk_ranges(count, 20, 1)) for count in (1, 100, 1000))
    assert small < medium < large


def test_progress_counts_chunks_not_jobs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for first, last in ((0, 0), (20, 39)):
        path = chunks_file("p2024", "one", first, last)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("{}")
    sizes = (100, 20, 1)
    assert progress(["p2024/one"], sizes) == "campaign: 21 of 100 chunks"
    assert progress(["p2024/one"], sizes, new=21, seconds=42.0) == "campaign: 21 of 100 chunks, about 3 min remain"
    assert progress(["p2024/one"], sizes, new=21, seconds=21.0).endswith("about 79 s remain")


@pytest.fixture
def campaign(tmp_path):
    """A tree with a large campaign that fits its code and inputs."""
    (tmp_path / "papers/p2024").mkdir(parents=True)
    (tmp_path / "papers/p2024/campaign.py").write_text("SIZE = 1\n")

    def record(path, **content):
        file = tmp_path / record_path(path)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(content))

    inputs = {"results/p2024/model.json": "aa", "results/p2024/ensemble/one/chunks-000000-000000.json": "gone"}
    record("results/p2024/model.json", sha256="aa")
    code = standing.code_digest("p2024", tmp_path)
    record(distribution_file("p2024", "one", "campaign"), sha256="bb", code=code, inputs=inputs)
    standing.code_digest.cache_clear()
    return tmp_path, record


def test_a_campaign_that_fits_is_current(campaign):
    assert standing.overtaken("p2024", "one", campaign[0]) is None


def test_edited_code_overtakes_a_campaign(campaign):
    (campaign[0] / "papers/p2024/campaign.py").write_text("SIZE = 2\n")
    assert standing.overtaken("p2024", "one", campaign[0]) == "its code was edited since"


def test_a_renewed_artifact_overtakes_a_campaign(campaign):
    folder, record = campaign
    record("results/p2024/model.json", sha256="cc")
    assert standing.overtaken("p2024", "one", folder) == "results/p2024/model.json was made anew since"


def test_a_campaign_without_record_is_not_trusted(campaign):
    assert standing.overtaken("p2024", "two", campaign[0]) == "it has no record of how it was made"
