"""A campaign that does not say what is proven of its members is refused, in words."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from recontrol.errors import StageError
from recontrol.pipeline.campaign import bounds_of
from recontrol.pipeline.closure import BOUNDS


@pytest.mark.parametrize(
    ("key", "content", "refused"),
    [
        ("none2024", None, "papers/none2024/campaign_bounds.py: missing"),
        ("other2024", "def other():\n    return {}\n", "papers/other2024/campaign_bounds: has no function 'one_way'"),
    ],
)
def test_a_campaign_without_bounds_is_refused(tmp_path, monkeypatch, key, content, refused):
    folder = tmp_path / "papers" / key
    folder.mkdir(parents=True)
    if content is not None:
        (folder / f"{BOUNDS}.py").write_text(content)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(StageError, match="campaign 'one-way' needs a function of its name there") as raised:
        bounds_of(SimpleNamespace(key=key), "one-way")
    assert refused in str(raised.value)
