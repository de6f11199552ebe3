"""The chain on a toy paper of four tiny stages: each test breaks one thing and looks at what the plain command does."""

from __future__ import annotations

import inspect
import json
import os
import re
import signal
import time
from types import SimpleNamespace

import pytest

from recontrol import skeleton
from recontrol.errors import ArtifactError, RecontrolError
from recontrol.pipeline import closure, guard, store
from tests.conftest import ROOT

NOTHING = "Nothing to be done"


def jobs(output: str) -> set[str]:
    """The messages of the jobs that a run started."""
    return set(re.findall(r"^(?:Local)?Job \d+: (.+)$", output, re.MULTILINE))


def verdicts(project) -> dict[str, str]:
    content = json.loads((project.folder / "results/toy2024/verdicts.json").read_text())
    return {claim["id"]: claim["verdict"] for claim in content["claims"]}


def test_second_run_has_nothing_to_do(toy):
    assert NOTHING in toy.snakemake("all").stdout


def test_edit_of_an_imported_module_reruns_exactly_what_depends_on_it(toy):
    toy.edit("papers/toy2024/helper.py", "FACTOR = 5", "FACTOR = 5  # halves")
    output = toy.snakemake("all").stdout
    assert "look at results/report/index.html" in output
    ran = {message for message in jobs(output) if message.startswith("toy2024")}
    assert ran == {
        "toy2024: synthesis gain",
        "toy2024: synthesis other",
        "toy2024: simulation decay",
        "toy2024: figure decay",
        "toy2024: verdicts",
        "toy2024: quantities",
        "toy2024: review",
        "toy2024: basis of the ensembles",
        "toy2024: poles, chunks 000000 to 000000",
        "toy2024: poles, distributions",
    }


def test_edit_of_the_verdict_rules_reruns_verdicts_only(toy):
    toy.edit("src/recontrol/claims/verdict.py", 'BROKEN = "broken"', 'BROKEN = "broken"  # a word')
    ran = {message for message in jobs(toy.snakemake("toy2024").stdout) if message.startswith("toy2024")}
    assert ran == {"toy2024: verdicts", "toy2024: review"}


def test_edit_of_one_figure_reruns_figures_only(toy):
    toy.edit("papers/toy2024/figures.py", '"state", "1"', '"level", "1"')
    ran = {message for message in jobs(toy.snakemake("toy2024").stdout) if message.startswith("toy2024")}
    assert ran == {"toy2024: figure decay", "toy2024: review"}


def test_failing_stage_fails_again_and_leaves_no_old_verdict(toy):
    before = toy.artifacts()
    toy.edit("papers/toy2024/simulation.py", "pole = float", 'raise ArithmeticError("diverged")\n    pole = float')
    for _ in range(2):
        result = toy.snakemake("all", check=False)
        assert result.returncode != 0
        assert "diverged" in result.stdout
        assert "run/log/toy2024/simulation/decay.log" in result.stdout
        found = verdicts(toy)
        assert found["fig1-decay"] == "failed"
        assert found["eq2-k"] == "reproduced"
        assert "failed" in (toy.folder / "results/report/toy2024.html").read_text()
    toy.edit("papers/toy2024/simulation.py", 'raise ArithmeticError("diverged")\n    ', "")
    toy.snakemake("all")
    assert toy.artifacts() == before


@pytest.mark.parametrize("name", ["results/toy2024/synthesis/gain.json", "figures/toy2024/decay.csv"])
def test_hand_edited_artifact_is_named_and_rebuilt(toy, name):
    before = toy.artifacts()
    path = toy.folder / name
    path.write_bytes(path.read_bytes().replace(b"5", b"6", 1))
    result = toy.snakemake("all")
    assert f"{name} differs from its record" in result.stdout
    assert toy.artifacts() == before
    assert (toy.folder / "run/set-aside" / name).exists()


def test_stage_refuses_an_artifact_edited_while_the_run_goes_on(toy):
    path = toy.folder / "results/toy2024/model.json"
    path.write_text(path.read_text().replace("1/2", "1/3"))
    result = toy.pipeline("stage", "synthesis", "toy2024", "gain")
    assert result.returncode == 1
    assert "results/toy2024/model.json: differs from its record" in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize("name", ["results/toy2024/model.json", "results/toy2024/simulation/decay.npz"])
def test_deleted_intermediate_is_rebuilt(toy, name):
    before = toy.artifacts()
    (toy.folder / name).unlink()
    toy.snakemake("all")
    assert toy.artifacts() == before


@pytest.mark.parametrize("delay", [0.6, 1.6, 2.4])
def test_plain_command_recovers_from_kill(fresh_toy, built_toy, delay):
    project = fresh_toy("killed")
    run = project.start("all")
    time.sleep(delay)
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    project.snakemake("all")
    assert project.artifacts() == built_toy.artifacts()


def test_second_run_is_refused_in_words(toy):
    before = toy.artifacts()
    toy.edit("papers/toy2024/helper.py", "FACTOR = 5", "import time\n\ntime.sleep(6)\nFACTOR = 5")
    first = toy.start("toy2024")
    try:
        wait_for(lambda: "synthesis" in first.stdout.readline())
        second = toy.snakemake("toy2024", check=False)
        assert second.returncode == 1
        assert "another run is going on in this directory" in second.stdout
        assert "Traceback" not in second.stdout
    finally:
        first.communicate()
    assert first.returncode == 0
    toy.edit("papers/toy2024/helper.py", "import time\n\ntime.sleep(6)\n", "")
    toy.snakemake("all")
    assert toy.artifacts() == before


def wait_for(condition, seconds: float = 30.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited too long"


def test_two_clean_runs_give_identical_bytes(fresh_toy, built_toy):
    project = fresh_toy("second")
    project.snakemake("all")
    assert project.artifacts() == built_toy.artifacts()
    kinds = {name.rsplit(".", 1)[-1] for name in built_toy.artifacts()}
    assert {"json", "csv", "npz", "png", "svg", "pdf", "html"} <= kinds


def test_new_folder_adds_its_own_jobs_and_no_others(toy):
    """The folder is a new skeleton, which runs as it is and agrees with its own review."""
    skeleton.create(toy.folder, "smith2024")
    ran = jobs(toy.snakemake("all").stdout)
    assert {"smith2024: verdicts", "smith2024: figure decay", "smith2024: review"} <= ran
    assert not {message for message in ran if message.startswith("toy2024")}


def test_undeclared_import_fails_the_stage(toy):
    toy.edit("papers/toy2024/synthesis.py", "from .helper import FACTOR", "FACTOR = 5")
    toy.edit(
        "papers/toy2024/synthesis.py",
        "def gain(model):\n",
        'def gain(model):\n    __import__("papers.toy2024.helper")\n',
    )
    result = toy.snakemake("toy2024", check=False)
    assert result.returncode != 0
    assert "imported papers/toy2024/helper.py, which its rule does not declare" in result.stdout


def test_unexpected_verdict_fails_the_run_with_both_shown(toy):
    toy.edit("papers/toy2024/paper.yaml", 'printed: "1.25"', 'printed: "1.26"')
    result = toy.snakemake("all", check=False)
    assert result.returncode != 0
    assert re.search(r"eq2-k\s+expected reproduced\s+found erratum", result.stdout)
    check = toy.snakemake("check", check=False)
    assert check.returncode != 0
    assert re.search(r"eq2-k\s+expected reproduced\s+found erratum", check.stdout)


def test_drifting_figure_fails_with_a_picture(toy):
    path = toy.folder / "papers/toy2024/reference/decay.csv"
    rows = path.read_text().splitlines()
    label, x, y = rows[40].split(",")
    rows[40] = f"{label},{x},{float(y) + 0.01}"
    path.write_text("\n".join(rows) + "\n")
    result = toy.snakemake("toy2024", check=False)
    assert result.returncode != 0
    assert "see run/drift/toy2024/decay.png" in result.stdout
    assert (toy.folder / "run/drift/toy2024/decay.png").stat().st_size > 1000


@pytest.mark.parametrize(
    ("name", "old", "new", "message"),
    [
        ("paper.yaml", "year:", "yaer:", "paper.yaml:4: yaer: Extra inputs are not permitted"),
        ("paper.yaml", "title: A", "title: &x A", "paper.yaml:2: anchor &x"),
        ("claims.yaml", "id: eq3-P", "id: eq2-k", "the id stands twice (first at line 1)"),
        ("claims.yaml", "data: P", "data: Q", "data 'Q' is not a name"),
        ("claims.yaml", "note: sign", "note: sing", "note 'sing' has no heading"),
        ("claims.yaml", 'except: "2,2"', 'except: "3,2"', "does not fit a 2 x 2 matrix"),
    ],
)
def test_malformed_folder_stops_with_one_clear_message(toy, name, old, new, message):
    before = toy.artifacts()
    toy.edit(f"papers/toy2024/{name}", old, new)
    result = toy.snakemake("all", check=False)
    assert result.returncode != 0
    assert message in result.stdout
    assert "Traceback" not in result.stdout
    if name == "paper.yaml":
        assert toy.artifacts() == before


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('return synthesis["gain"]["k"]', "return float('nan')", "a value of type float has no strength"),
        ('return synthesis["gain"]["k"]', 'return synthesis["gian"]', "stage synthesis has no part 'gian'"),
        ("def gain(synthesis)", "def gain(synthesis, quantity)", "argument 'quantity' of gain is unknown here"),
        ("[third, fmpq(2)]]", "[third, fmpq(2)], [third, third]]", "shape (3, 2), the print has (2, 2)"),
        ("def gain(", "def gian(", "has no function 'gain'"),
    ],
)
def test_broken_reading_makes_its_claim_failed_and_names_the_cause(toy, old, new, message):
    toy.edit("papers/toy2024/readings.py", old, new)
    result = toy.snakemake("all", check=False)
    assert result.returncode != 0
    assert message in result.stdout
    found = verdicts(toy)
    assert list(found.values()).count("failed") == 1


def test_quantity_without_a_value_is_named(toy):
    toy.edit("papers/toy2024/quantities.py", "time_constant", "time")
    result = toy.snakemake("toy2024", check=False)
    assert result.returncode != 0
    assert "quantities of paper.yaml without a value: time_constant" in result.stdout


def test_non_finite_artifact_is_refused(toy):
    before = toy.artifacts()
    toy.edit("papers/toy2024/simulation.py", '{"pole": pole}', '{"pole": float("inf")}')
    result = toy.snakemake("toy2024", check=False)
    assert result.returncode != 0
    assert "value.pole is inf" in result.stdout
    assert verdicts(toy)["fig1-decay"] == "failed"
    toy.edit("papers/toy2024/simulation.py", '{"pole": float("inf")}', '{"pole": pole}')
    toy.snakemake("all")
    assert toy.artifacts() == before


def test_orphan_of_a_killed_run_writes_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "run").mkdir()
    (tmp_path / "run/current").write_text("newer")
    monkeypatch.setenv("RECONTROL_RUN", "older")
    with pytest.raises(ArtifactError, match="a run that has ended"):
        store.publish({"results/x.json": b"1"}, {})
    assert not (tmp_path / "results").exists()


def test_lock_goes_with_its_holder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("RECONTROL_RUN", "")
    guard.enter([])
    with pytest.raises(RecontrolError, match="another run is going on"):
        guard.enter([])
    guard._held.pop().close()
    guard.enter([])
    guard._held.pop().close()


def test_closure_follows_function_level_and_relative_imports(built_toy):
    files = closure.code_of("synthesis", "toy2024", built_toy.folder)
    assert "papers/toy2024/helper.py" in files
    assert "papers/toy2024/simulation.py" not in files
    assert "papers/toy2024/helper.py" not in closure.code_of("model", "toy2024", built_toy.folder)
    assert "src/recontrol/plotting.py" in closure.code_of("figure", "toy2024", built_toy.folder)


def test_campaign_resumes_and_contains_the_small_ensemble(toy):
    toy.edit("config/campaign.yaml", "campaign_chunks: 100", "campaign_chunks: 5")
    toy.edit("config/campaign.yaml", "campaign_batch: 20", "campaign_batch: 2")
    toy.snakemake("results/toy2024/ensemble/poles/chunks-000001-000001.json")
    ran = jobs(toy.snakemake("campaign").stdout)
    first, second = ("toy2024: poles, chunks 000002 to 000003", "toy2024: poles, chunks 000004 to 000004")
    assert ran == {first, second, "toy2024: poles, large campaign"}
    large = json.loads((toy.folder / "results/toy2024/campaign/poles.json").read_text())["outcomes"]["decay"]
    small = json.loads((toy.folder / "results/toy2024/ensemble/poles.json").read_text())["outcomes"]["decay"]
    assert (small["count"], large["count"]) == (1000, 5000)
    assert large["minimum"] <= small["minimum"]
    assert large["minimum"] >= large["bound"]


def test_a_function_of_the_package_comes_before_one_of_its_topics(tmp_path):
    """Topics may have a function of the same name, which the package calls."""
    folder = tmp_path / "papers" / "p2024" / "quantities"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("from . import design\n\n\ndef quantities():\n    return design.quantities()\n")
    (folder / "design.py").write_text("def quantities():\n    return {}\n\n\ndef table():\n    return 1\n")
    assert closure.home_of("p2024", "quantities", "quantities", tmp_path) == "papers.p2024.quantities"
    assert closure.home_of("p2024", "quantities", "table", tmp_path) == "papers.p2024.quantities.design"
    assert closure.home_of("p2024", "quantities", "missing", tmp_path) == "papers.p2024.quantities"


def test_size_of_the_jobs_of_a_campaign_changes_no_byte(toy):
    toy.edit("config/campaign.yaml", "campaign_chunks: 100", "campaign_chunks: 5")
    made = []
    for batch in ("campaign_batch: 20", "campaign_batch: 2"):
        toy.edit("config/campaign.yaml", "campaign_batch: 20", batch)
        toy.snakemake("campaign")
        made.append({path.name: path.read_bytes() for path in (toy.folder / "results/toy2024/campaign").iterdir()})
    assert made[0] == made[1]


def test_report_shows_a_large_campaign_once_it_is_there_and_says_when_it_is_overtaken(toy):
    toy.edit("config/campaign.yaml", "campaign_chunks: 100", "campaign_chunks: 2")
    page = toy.folder / "results/report/toy2024.html"
    assert "Large campaign" not in page.read_text()
    toy.snakemake("campaign")
    ran = jobs(toy.snakemake("all").stdout)
    assert not [name for name in ran if "chunk" in name or "campaign" in name]
    assert "Large campaign: 2000 trajectories" in page.read_text()
    assert "Out of date" not in page.read_text()
    assert NOTHING in toy.snakemake("all").stdout
    toy.edit("papers/toy2024/paper.yaml", "ten percent off", "10 percent off")
    assert "toy2024: poles, large campaign" not in jobs(toy.snakemake("all").stdout)
    assert "Out of date: results/toy2024/ensemble-basis.json was made anew since" in page.read_text()
    toy.edit("papers/toy2024/campaign.py", "0.9, 1.1", "0.95, 1.05")
    toy.snakemake("all")
    assert "Out of date: its code was edited since" in page.read_text()


def test_a_trajectory_beyond_its_proven_bound_fails_the_merge(toy):
    toy.edit("papers/toy2024/campaign_bounds.py", "- 1.1 *", "- 1.0 *")
    output = toy.snakemake("all", check=False).stdout
    assert re.search(r"outcome 'decay': trajectory \d+ \(chunk 0, member \d+, seed 2024\) gives", output)
    assert "the end of the interval" in output


def test_a_campaign_has_to_state_what_is_proven_of_every_outcome(toy):
    toy.edit("papers/toy2024/campaign_bounds.py", '{"decay": Bound', '{"delay": Bound')
    output = toy.snakemake("all", check=False).stdout
    assert "states ['delay'], paper.yaml names the outcomes ['decay']" in output


@pytest.mark.parametrize(("local", "left"), [(True, None), (False, "limit")])
def test_the_rate_limit_is_lifted_for_local_runs_alone(local, left):
    workflow = SimpleNamespace(local_exec=local, scheduler=SimpleNamespace(job_rate_limiter="limit"))
    guard.lift_rate_limit(workflow)
    assert workflow.scheduler.job_rate_limiter == left


def test_snakemake_still_keeps_its_rate_limit_where_it_is_lifted():
    from snakemake.scheduling.job_scheduler import JobScheduler

    source = inspect.getsource(JobScheduler)
    assert "self.job_rate_limiter = (" in source
    assert "if self.job_rate_limiter is None:" in source


def test_a_figure_depends_on_its_own_topic_alone():
    first = closure.code_of("figure", "wan2014", ROOT, figure="fig5")
    other = closure.code_of("figure", "wan2014", ROOT, figure="si-answers")
    assert "papers/wan2014/figures/published.py" in first
    assert "papers/wan2014/figures/findings.py" not in first
    assert "papers/wan2014/figures/findings.py" in other


def test_what_is_remembered_of_imports_goes_by_content(tmp_path, monkeypatch):
    """An edited source is not known yet; a memory that cannot be read is none."""
    monkeypatch.setattr(closure, "MEMORY", tmp_path / "imports.json")
    for text in ("no JSON", "[1, 2]", "{}"):
        closure.MEMORY.write_text(text)
        closure._memory.cache_clear()
        assert closure._statements(b"import a") == [(0, "a", [])]
    closure.remember()
    closure._memory.cache_clear()
    assert list(closure._memory().values()) == [[(0, "a", [])]]
    assert closure._statements(b"import b") == [(0, "b", [])]
    closure._memory.cache_clear()
