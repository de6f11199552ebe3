"""The pages in a real browser: no errors, no requests, no sideways scrolling, filter and zoom, keyboard, no script."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fake
import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"]  # fmt: skip


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    if CHROMIUM is None:
        if os.environ.get("RECONTROL_REQUIRE_BROWSER") == "1":
            pytest.fail("RECONTROL_REQUIRE_BROWSER=1, but no chromium is installed")
        pytest.skip("no chromium on this machine (Debian: apt-get install chromium)")
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as driver:
        started = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield started
        started.close()


def show(browser: Any, tree: Path, place: str, width: int = 1280, **options: Any) -> Any:
    page = browser.new_context(viewport={"width": width, "height": 900}, **options).new_page()
    page.trouble = []
    page.on("console", lambda message: page.trouble.append(message.text))
    page.on("pageerror", lambda error: page.trouble.append(str(error)))
    page.on(
        "request",
        lambda request: page.trouble.extend([] if request.url.startswith(("file:", "data:")) else [request.url]),
    )
    page.on("requestfailed", lambda request: page.trouble.append(request.url))
    page.goto(f"file://{tree}/results/report/{place}")
    return page


@pytest.mark.parametrize(
    "place", ["index.html", f"{fake.KEY}.html", f"source/papers/{fake.KEY}/readings/loops.py.html"]
)
@pytest.mark.parametrize("width", [400, 800, 1280])
def test_pages_load_clean_and_fit_the_width(browser: Any, tree: Path, place: str, width: int) -> None:
    page = show(browser, tree, place, width)
    page.wait_for_load_state("load")
    assert page.trouble == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_filter_works_without_script(browser: Any, tree: Path) -> None:
    page = show(browser, tree, f"{fake.KEY}.html", java_script_enabled=False)
    assert page.locator("#eq55-11").is_visible()
    page.locator("label:has(#v-erratum)").click()
    assert not page.locator("#eq55-11").is_visible()
    assert page.locator("#eq6-tf").is_visible()
    page.locator("label:has(#s-exact)").click()
    assert not page.locator("#eq6-tf").is_visible()


def test_first_click_shows_one_verdict_alone_and_the_last_shows_all(browser: Any, tree: Path) -> None:
    page = show(browser, tree, f"{fake.KEY}.html")
    page.locator("label:has(#v-erratum)").click()
    assert page.locator("#eq55-11").is_visible()
    assert not page.locator("#eq6-tf").is_visible()
    page.locator("label:has(#v-reproduced)").click()
    assert page.locator("#eq6-tf").is_visible()
    page.locator("label:has(#v-reproduced)").click()
    page.locator("label:has(#v-erratum)").click()
    assert page.locator("#s3-pattern").is_visible()


def test_search_counts_and_a_link_brings_a_hidden_claim_back(browser: Any, tree: Path) -> None:
    page = show(browser, tree, f"{fake.KEY}.html")
    page.fill("#q", "(55)")
    assert page.inner_text("#hits") == "2 of 10 claims"
    assert not page.locator("#eq6-tf").is_visible()
    page.evaluate("location.hash = '#eq6-tf'")
    page.wait_for_timeout(50)
    assert page.locator("#eq6-tf").is_visible()
    assert page.locator("#eq6-tf .readings").get_attribute("open") is not None


def test_search_on_the_overview_opens_the_paper(browser: Any, tree: Path) -> None:
    page = show(browser, tree, "index.html")
    page.fill("#q", "upper left")
    link = page.get_by_role("link", name="upper left block of the loop")
    assert link.is_visible()
    link.click()
    assert page.locator("#eq55-11").is_visible()
    assert page.url.endswith(f"{fake.KEY}.html#eq55-11")


def test_figures_zoom_with_the_keyboard_and_close_with_escape(browser: Any, tree: Path) -> None:
    page = show(browser, tree, f"{fake.KEY}.html")
    page.locator("a.zoom").first.focus()
    page.keyboard.press("Enter")
    assert page.locator("dialog").is_visible()
    page.keyboard.press("Escape")
    assert not page.locator("dialog").is_visible()


def test_the_first_tab_stop_skips_to_the_content(browser: Any, tree: Path) -> None:
    page = show(browser, tree, f"{fake.KEY}.html")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Skip to the content"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_has_enough_contrast(browser: Any, tree: Path, scheme: str) -> None:
    page = show(browser, tree, f"{fake.KEY}.html", color_scheme=scheme)
    low = page.evaluate((fake.DATA / "contrast.js").read_text())
    assert low == []
