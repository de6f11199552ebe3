"""Malformed paper folders: never a traceback, never accepted nonsense.

RECONTROL_FUZZ sets the number of cases of each kind (default 400; `make faults` runs 10,000).
"""

from __future__ import annotations

import os
import random
import re
import shutil
from pathlib import Path

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from recontrol import paper as papers
from recontrol import yamltext
from recontrol.claims import schema
from recontrol.errors import PaperError

TOY = Path(__file__).parent / "toy/toy2024"
CASES = int(os.environ.get("RECONTROL_FUZZ", "400"))
REFERENCES = (
    "&a|*a|!!python/object:os.system|!x|<<: {}|? x|- |: |{|}|[|]|>|'|\"|\t|\x00|---|...|%YAML 1.3|nan|1e999|null|~|#|é"
)
LOADER = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
WORDS = [*REFERENCES.split("|"), "|", "\u2028", "0x10", "true", "1_0"]
fuzz = settings(
    derandomize=True,
    deadline=None,
    max_examples=CASES,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def mutate(text: str, seed: int) -> str:
    """A few seeded edits of a file: lines lost, doubled, swapped, indented; words and characters put in or changed."""
    rng = random.Random(seed)
    for _ in range(rng.randint(1, 4)):
        lines = text.splitlines(keepends=True) or [""]
        at = rng.randrange(len(lines))
        line = lines[at]
        kind = rng.randrange(8)
        if kind == 0:
            del lines[at]
        elif kind == 1:
            lines.insert(at, line)
        elif kind == 2:
            other = rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], line
        elif kind == 3:
            lines[at] = " " * rng.randint(1, 3) + line
        elif kind == 4:
            place = rng.randint(0, len(line))
            lines[at] = line[:place] + rng.choice(WORDS) + line[place:]
        elif kind == 5 and line.strip():
            place = rng.randrange(len(line))
            lines[at] = line[:place] + chr(rng.randrange(32, 127)) + line[place + 1 :]
        elif kind == 6:
            lines = lines[: at + 1]
        else:
            words = re.findall(r"\S+", line)
            if words:
                lines[at] = line.replace(rng.choice(words), rng.choice(WORDS), 1)
        text = "".join(lines)
    return text


def references(text: str) -> list[object]:
    """Anchors, aliases and tags, found by the scanner of the YAML library."""
    return [
        token
        for token in yaml.scan(text, Loader=LOADER)
        if isinstance(token, (yaml.AnchorToken, yaml.AliasToken, yaml.TagToken))
    ]


def printed(text: str, name: str) -> list[str]:
    """The printed texts of a file as the YAML library reads them, without any schema."""
    tree = yaml.load(text, Loader=LOADER)
    items = tree["data"].values() if name == "paper.yaml" else tree
    return [item["printed"].strip() for item in items if item.get("printed")]


def understood(paper, claims, name: str) -> list[str]:
    """The same from what was accepted."""
    if name == "paper.yaml":
        return [paper.data.text(datum).strip() for datum in paper.file.data]
    return [claim.printed.strip() for claim in claims if claim.printed]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    target = tmp_path_factory.mktemp("fuzz") / "toy2024"
    shutil.copytree(TOY, target)
    return target


@pytest.mark.parametrize("name", ["paper.yaml", "claims.yaml"])
def test_mutated_files_are_refused_in_words_or_mean_what_they_say(folder, name, record_property):
    original = (TOY / name).read_text()
    messages: list[str] = []
    for seed in range(CASES):
        text = mutate(original, seed)
        (folder / name).write_text(text, encoding="utf-8")
        try:
            paper = papers.load(folder)
            claims = schema.load(paper)
        except PaperError as error:
            messages.append(str(error))
            continue
        assert not references(text), f"seed {seed}: a reference was accepted"
        assert printed(text, name) == understood(paper, claims, name), f"seed {seed}"
        assert claims
        for claim in claims:
            assert claim.expected.verdict in ("reproduced", "reproduced-under-assumption", "unspecified", "erratum",
                                              "certified", "not-reproduced", "failed")  # fmt: skip
    (folder / name).write_text(original)
    record_property("cases", CASES)
    record_property("accepted", CASES - len(messages))
    assert len(messages) > CASES // 4
    assert all(name in message for message in messages)


@fuzz
@given(
    st.recursive(
        st.none() | st.text(max_size=8) | st.integers() | st.floats(allow_nan=True),
        lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=6), inner, max_size=4),
        max_leaves=12,
    )
)
def test_arbitrary_trees_are_refused(folder, tree):
    path = folder / "paper.yaml"
    original = (TOY / "paper.yaml").read_text()
    path.write_text(yaml.safe_dump(tree, allow_unicode=True), encoding="utf-8")
    try:
        with pytest.raises(PaperError, match=r"paper\.yaml"):
            papers.load(folder)
    finally:
        path.write_text(original)


@fuzz
@given(st.binary(max_size=200))
def test_arbitrary_bytes_are_refused_or_read_as_text(tmp_path, content):
    path = tmp_path / "x.yaml"
    path.write_bytes(content)
    try:
        tree, _ = yamltext.load(path)
    except PaperError:
        return
    stack = [tree]
    while stack:
        item = stack.pop()
        if isinstance(item, dict):
            stack += [*item.keys(), *item.values()]
        elif isinstance(item, list):
            stack += item
        else:
            assert item is None or isinstance(item, str)


@pytest.mark.parametrize(
    "text", ["[" * 5000, "{a: " * 3000, "a:\n" + "".join(" " * i + "- \n" for i in range(200)), "x" * 3_000_000]
)
def test_hostile_sizes_are_refused(tmp_path, text):
    path = tmp_path / "x.yaml"
    path.write_text(text)
    with pytest.raises(PaperError, match=r"x\.yaml"):
        yamltext.load(path)
