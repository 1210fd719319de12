"""Sphinx extension: faults of the theme's own markup that keep somebody out, mended in the built pages.

The dialogs of menu, contents and search have no name. The name of the search button is not what it
shows, and neither is the name of the button for light and dark, whose three icons have titles. Logo
and title stand in no landmark. The viewport is declared three times.
"""

import re
from pathlib import Path
from typing import Any, NamedTuple


class ThemeFault(NamedTuple):
    """What the theme writes, and what it should write."""

    written: re.Pattern[str]
    mended: str
    everywhere: bool = True
    """Whether each page has it: then one without it shows that the theme has another form."""


def name_dialog(element: str, name: str) -> ThemeFault:
    """Return the fault of a dialog that has no name."""
    return ThemeFault(
        re.compile(rf'<dialog id="{element}">'),
        rf'<dialog id="{element}" aria-label="{name}">',
        False,
    )


VIEWPORT = re.compile(r'\s*<meta name="viewport"[^>]*>')
FAULTS = (
    name_dialog("pst-primary-sidebar-modal", "Menu"),
    name_dialog("pst-secondary-sidebar-modal", "Contents of this page"),
    name_dialog("pst-search-dialog", "Search"),
    ThemeFault(
        re.compile(r'(<button class="btn search-button-field[^>]*) aria-label="Search"'), r"\1"
    ),
    ThemeFault(
        re.compile(r'(<i class="theme-switch [^>]*) title="[\w ]+"'), r'\1 aria-hidden="true"'
    ),
    ThemeFault(
        re.compile(r'<div class="sidebar-primary-item">(?=\s*<a class="navbar-brand logo")'),
        '<div class="sidebar-primary-item" role="navigation" aria-label="Front page">',
    ),
)


def mend(page: str) -> str:
    """Return a built page without these faults."""
    for fault in FAULTS:
        page, count = fault.written.subn(fault.mended, page)
        if fault.everywhere and not count:
            raise ValueError(f"nothing like {fault.written.pattern} on a page: the theme has another form")
    first = VIEWPORT.search(page)
    return page[: first.end()] + VIEWPORT.sub("", page[first.end() :]) if first else page


def finish(app: Any, exception: Exception | None) -> None:
    """Mend the pages that have the theme."""
    if exception or app.builder.format != "html":
        return
    site = Path(app.outdir)
    for path in site.rglob("*.html"):
        page = path.read_text(encoding="utf-8")
        if 'id="pst-primary-sidebar"' in page:
            path.write_text(mend(page), encoding="utf-8")


def setup(app: Any) -> dict[str, bool]:
    app.connect("build-finished", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
