"""Take the README's picture of the report: docs/images/report.png, from a finished run. Needs chromium.

python tools/picture.py [PAPER]
"""

import shutil
import sys
from pathlib import Path

TARGET = Path("docs/images/report.png")
SIZE = {"width": 1120, "height": 900}


def main(arguments):
    """Photograph the top of a paper's page: advice, counts and the first claims."""
    from playwright.sync_api import sync_playwright

    page_file = Path(f"results/report/{arguments[0] if arguments else 'hashim2015'}.html")
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not page_file.exists():
        sys.exit(f"picture: {page_file} is missing; run `snakemake --cores 2 all` first")
    if chromium is None:
        sys.exit("picture: no chromium on this machine (Debian: apt-get install chromium)")
    TARGET.parent.mkdir(exist_ok=True)
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page(viewport=SIZE, color_scheme="light")
        page.goto(page_file.resolve().as_uri())
        page.evaluate("document.getElementById('glance').scrollIntoView()")
        page.screenshot(path=TARGET)
        browser.close()
    print(TARGET)


if __name__ == "__main__":
    main(sys.argv[1:])
