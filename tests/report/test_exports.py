"""Exports for other tools and `recontrol.load`: the same numbers by another way of reading them."""

from __future__ import annotations

import csv
import io
import json
import zipfile
from pathlib import Path

import fake
import numpy as np
import pytest
from scipy.io import loadmat

import recontrol
from recontrol.errors import MissingArtifactError, UnknownNameError
from recontrol.report import exports

MODEL = {
    "yaw": {"A": {"exact": [["0", "1"], ["-1/4", "-1"]]}, "B": {"exact": [["0"], ["1"]]}, "C": [[1.0, 0.0]]},
    "poles": {"complex": {"re": [-0.5, -0.5], "im": [0.25, -0.25]}},
    "rate": {"ball": {"mid": "5/4", "rad": "1/1024"}},
    "pair": [{"exact": "1/3"}, {"re": {"ball": {"mid": "1", "rad": "0"}}, "im": {"ball": {"mid": "2", "rad": "0"}}}],
    "J": {"value": 2.5, "error": 1e-9},
    "none": None,
    "a-name with signs": "words",
    "a_name with signs": [1, 2, 3],
}
SYSTEMS = '''"""Systems for `recontrol.load`."""


def systems(data, model, synthesis):
    """The plant, and the published gain."""
    yaw = model["yaw"]
    return {"plant": (yaw["A"], yaw["B"], yaw["C"], 0), "controller": ([], [], [], data["K"])}
'''


@pytest.fixture
def project(tmp_path: Path) -> Path:
    root = fake.write(tmp_path)
    results = root / "results" / fake.KEY
    (results / "model.json").write_text(json.dumps(MODEL))
    (results / "simulation").mkdir()
    (results / "simulation" / "steps.json").write_text(json.dumps({"peak": {"exact": "3/2"}}))
    np.savez(results / "simulation" / "steps.npz", t=np.arange(3.0), x=np.arange(6.0).reshape(3, 2), s=np.array([0.1]))
    (root / "papers" / fake.KEY / "systems.py").write_text(SYSTEMS)
    return root


def test_matlab_reads_the_numbers_and_the_bytes_repeat(project: Path) -> None:
    files = exports.files(project, fake.KEY)
    model = loadmat(io.BytesIO(files[f"results/{fake.KEY}/model.mat"]), simplify_cells=True)
    np.testing.assert_array_equal(model["yaw"]["A"], [[0, 1], [-0.25, -1]])
    np.testing.assert_array_equal(model["poles"], [-0.5 + 0.25j, -0.5 - 0.25j])
    assert model["rate"] == 1.25
    assert model["J"] == 2.5
    assert model["a_name_with_signs"] == "words"
    np.testing.assert_array_equal(model["a_name_with_signs_2"], [1, 2, 3])
    assert files == exports.files(project, fake.KEY)
    assert b"Created on" not in files[f"results/{fake.KEY}/model.mat"][:128]


def test_plain_json_holds_floats_only(project: Path) -> None:
    model = json.loads(exports.files(project, fake.KEY)[f"results/{fake.KEY}/model.plain.json"])
    assert model["yaw"]["A"] == [[0.0, 1.0], [-0.25, -1.0]]
    assert model["poles"] == {"re": [-0.5, -0.5], "im": [0.25, -0.25]}
    assert model["none"] is None


def test_series_become_columns(project: Path) -> None:
    packed = exports.files(project, fake.KEY)[f"results/{fake.KEY}/series.zip"]
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        rows = list(csv.DictReader(io.StringIO(archive.read("steps.csv").decode())))
    assert [row["t"] for row in rows] == ["0.0", "1.0", "2.0"]
    assert [row["x[2]"] for row in rows] == ["1.0", "3.0", "5.0"]
    assert [row["s"] for row in rows] == ["0.1", "", ""]


def test_load_gives_claims_numbers_series_and_systems(project: Path) -> None:
    results = recontrol.load(fake.KEY, project)
    assert results.claims["eq55-11"].verdict == "erratum"
    assert results.quantities["margin"]["yaw"] == 12.25
    assert results.simulation["steps"]["values"] == {"peak": 1.5}
    assert results.simulation["steps"]["series"]["x"].shape == (3, 2)
    assert results.figures["fig3"].is_file()
    np.testing.assert_allclose(results.plant.poles(), [-0.5, -0.5], atol=1e-7)  # double pole: root of the rounding
    np.testing.assert_array_equal(results.systems["model/yaw"].A, [[0, 1], [-0.25, -1]])
    np.testing.assert_array_equal(results.controller.D, [[1.1790, 0.6951, 0.5147, 0.0974]])


def test_load_says_what_is_missing(project: Path) -> None:
    with pytest.raises(UnknownNameError, match="no paper 'nobody1999'"):
        recontrol.load("nobody1999", project)
    (project / "results" / fake.KEY / "model.json").unlink()
    with pytest.raises(MissingArtifactError, match="snakemake --cores 2 fake2020"):
        recontrol.load(fake.KEY, project)
