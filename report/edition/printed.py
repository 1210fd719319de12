"""The book's chapters in print: the pages of the site by Chromium's printer, one PDF."""

from __future__ import annotations

import base64
import io
from pathlib import Path

import yaml

from report import screenshots
from report.edition import CannotMake

REPORT = Path(__file__).resolve().parents[1]
LEFT_OUT = ("Using the benchmark",)
"""Parts of the table of contents that are about the tool."""
ON_THE_SCREEN = ("26-live", "03-regulators")
"""Pages to move things on, or to go on from."""
NAME = "orientation-bench.pdf"
A4 = {
    "paperWidth": 8.27,
    "paperHeight": 11.69,
    "marginTop": 0.55,
    "marginBottom": 0.6,
    "marginLeft": 0.55,
    "marginRight": 0.55,
}
SCALE = 0.63


def book(folder: Path) -> str:
    """The chapters as one PDF, without the pages that are about the tool."""
    from pypdf import PdfReader, PdfWriter

    missing = screenshots.missing()
    if missing:
        raise CannotMake(f"the print edition needs a browser: {missing}")
    writer = PdfWriter()
    with screenshots.browser() as driver:
        for page in chapters():
            screenshots.open_page(driver, page, screenshots.View("light", 1280))
            title = driver.find_element("css selector", "article h1").text.rstrip("#")
            first = len(writer.pages)
            writer.append(PdfReader(io.BytesIO(on_paper(driver))), import_outline=False)
            writer.add_outline_item(title=title, page_number=first)
    writer.add_metadata({"/Title": "Orientation regulators, measured"})
    with (folder / NAME).open("wb") as file:
        writer.write(file)
    return f"{len(writer.pages)} pages"


def chapters() -> list[Path]:
    """The pages of the site that go into print, in the order of the table of contents."""
    contents = yaml.safe_load((REPORT / "_toc.yml").read_text(encoding="utf-8"))
    globs = [
        chapter["glob"] for part in contents["parts"] if part["caption"] not in LEFT_OUT for chapter in part["chapters"]
    ]
    names = [
        path.stem for glob in globs for path in sorted(REPORT.glob(f"{glob}.md")) if path.stem not in ON_THE_SCREEN
    ]
    return [screenshots.SITE / "index.html", *(screenshots.SITE / "pages" / f"{name}.html" for name in names)]


def on_paper(driver) -> bytes:
    """The open page as a PDF, by the print style of the site."""
    made = driver.execute_cdp_cmd("Page.printToPDF", {**A4, "scale": SCALE, "printBackground": True})
    return base64.b64decode(made["data"])
