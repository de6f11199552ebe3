"""The pages: what they show, that they need nothing from outside, that links lead somewhere, and that bytes repeat."""

from __future__ import annotations

import hashlib
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path

import fake
import pytest

from recontrol import report
from recontrol.report.collect import Paper


class Page(HTMLParser):
    """Ids, links, loaded resources, and nesting of one page."""

    VOID = ("meta", "link", "img", "input", "br", "hr")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.open: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.ids += [found["id"]] if found.get("id") else []
        if tag == "a":
            self.links.append(found.get("href") or "")
        elif found.get("href") or found.get("src"):
            self.loaded.append(found.get("href") or found.get("src") or "")
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def pages(root: Path) -> dict[Path, Page]:
    files = sorted((root / "results" / "report").rglob("*.html"))
    return {path: Page(path.read_text(encoding="utf-8")) for path in files}


def text_of(root: Path, name: str = f"{fake.KEY}.html") -> str:
    return (root / "results" / "report" / name).read_text(encoding="utf-8")


def article(root: Path, claim: str) -> str:
    text = text_of(root)
    start = text.index(f'id="{claim}"')
    return text[start : text.index("</article>", start)]


def test_every_link_leads_to_a_file_and_an_anchor(tree: Path) -> None:
    made = pages(tree)
    assert len(made) == 3
    for path, page in made.items():
        for link in page.links:
            if link.startswith("https://doi.org/"):
                continue
            name, _, anchor = link.partition("#")
            target = (path.parent / name).resolve() if name else path
            assert target.is_file(), f"{path.name} links to {link}"
            if anchor and target.suffix == ".html" and "source" not in target.parts:
                assert anchor in made[target].ids, f"{path.name} links to {link}"


def test_nothing_is_loaded_from_outside(tree: Path) -> None:
    for path, page in pages(tree).items():
        for name in page.loaded:
            assert name == "data:," or (path.parent / name).is_file(), f"{path.name} loads {name}"
    for path in (tree / "results" / "report" / "assets").glob("*.css"):
        assert "http" not in path.read_text(encoding="utf-8")


def test_ids_are_unique_and_claims_have_permanent_anchors(tree: Path) -> None:
    for page in pages(tree).values():
        assert len(page.ids) == len(set(page.ids))
    anchors = Page(text_of(tree)).ids
    assert {claim.id for claim in Paper(tree, fake.KEY).claims} <= set(anchors)


def test_every_verdict_is_shown_and_scan_errata_are_counted_apart(tree: Path) -> None:
    counts = Paper(tree, fake.KEY).counts
    assert counts == {
        "reproduced": 1, "reproduced-under-assumption": 1, "certified": 1, "erratum": 2, "erratum-scan": 1,
        "not-reproduced": 1, "unspecified": 1, "failed": 2,
    }  # fmt: skip
    overview = text_of(tree, "index.html")
    assert 'data-label="erratum">2<' in overview
    assert 'data-label="erratum, may be the scan\'s">1<' in overview


def test_an_erratum_shows_print_definition_and_explanation_with_marked_digits(tree: Path) -> None:
    text = article(tree, "eq55-11")
    assert "-<mark>2.358</mark>" in text
    assert "-<mark>1.179</mark>" in text
    assert "does not give the print; the print is explained by “A - 2BK”" in text
    assert f'href="source/papers/{fake.KEY}/readings/loops.py.html#L-4"' in text
    assert '<a href="#note-twice">' in text
    assert "<math" in text


def test_the_correct_form_stands_beside_the_print(tree: Path) -> None:
    assert '<span class="role">correct</span> a shift row has <math' in article(tree, "eq55-e65")
    sheet = text_of(tree)[text_of(tree).index('id="errata"') :]
    assert '<span class="role">correct</span> a shift row has <math' in sheet or "0</mark>" in sheet


def test_the_table_of_all_claims_holds_print_and_finding(tree: Path) -> None:
    text = text_of(tree)
    table = text[text.index('class="glance') : text.index("</table>")]
    rows = table.split('<tr class="row"')[1:]
    assert len(rows) == len(Paper(tree, fake.KEY).claims)
    (row,) = [row for row in rows if 'href="#eq65-2"' in row]
    assert re.findall(r'data-label="(printed|found)">(.*?)</td>', row) == [("printed", "0.5147"), ("found", "0.5148")]


def test_only_cells_of_the_claim_are_compared(tree: Path) -> None:
    text = article(tree, "eq65-2")
    assert text.count("<mark>") == 2
    assert "0.514<mark>7</mark>" in text
    assert "0.514<mark>8</mark>" in text
    assert 'class="out"' in text


def test_cases_certificates_and_messages_are_shown(tree: Path) -> None:
    assert "margin = -0.25" in article(tree, "s3-pattern")
    assert 'href="#cert-loop-full"' in article(tree, "eq44-K")
    assert f"recontrol verify results/{fake.KEY}/certificates/loop-full.json" in text_of(tree)
    assert "SolverError: &lt;no&gt; answer" in article(tree, "s2-broken")
    assert "entry of the reference, scales" in article(tree, "fig3-curves")


def test_a_claim_without_a_verdict_is_failed_and_differs_from_the_review(tree: Path) -> None:
    assert "No verdict was made" in article(tree, "s2-absent")
    assert "2 verdicts differ from the reviewed one" in text_of(tree)


def test_paper_text_is_escaped(tree: Path) -> None:
    assert "<test>" not in text_of(tree)
    assert "&lt;test&gt;" in text_of(tree)


def test_solvers_and_quantities_are_shown_without_times(tree: Path) -> None:
    text = text_of(tree)
    assert "inaccurate" in text
    assert "seconds" not in text
    assert "0.333333" in text


@pytest.mark.parametrize("gone", ["results", "figures", f"results/{fake.KEY}/verdicts.json"])
def test_missing_artifacts_are_shown_and_never_crash(tmp_path: Path, gone: str) -> None:
    root = fake.write(tmp_path)
    path = root / gone
    shutil.rmtree(path) if path.is_dir() else path.unlink()
    report.build(root, [fake.KEY])
    if gone != "figures":
        assert Paper(root, fake.KEY).counts == {"failed": 10}
    assert "This figure was not made in this run." in text_of(root)


def test_a_broken_artifact_is_a_failed_claim(tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    (root / "results" / fake.KEY / "verdicts.json").write_text('{"claims": [')
    report.build(root, [fake.KEY])
    assert Paper(root, fake.KEY).counts == {"failed": 10}


def test_equal_inputs_give_equal_bytes_wherever_the_tree_lies(tree: Path, tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    report.build(root, [fake.KEY])
    digests = []
    for base in (tree, root):
        files = sorted((base / "results" / "report").rglob("*"))
        digests.append({f.relative_to(base): hashlib.sha256(f.read_bytes()).digest() for f in files if f.is_file()})
    assert digests[0] == digests[1]


def test_a_second_build_replaces_the_first(tmp_path: Path) -> None:
    root = fake.write(tmp_path)
    report.build(root, [fake.KEY])
    stale = root / "results" / "report" / "gone.html"
    stale.write_text("old")
    report.build(root, [fake.KEY])
    assert not stale.exists()
    assert list((root / "run").iterdir()) == []
