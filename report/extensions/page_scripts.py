"""Sphinx extension: a page loads the scripts of what it holds, and no other page does."""

from typing import Any

SCRIPTS = {
    "<video data-film=": "films.js",  # gives a film the file of the reader's theme
    'class="math"': "scrolled.js",  # lets keys scroll what is wider than its box
    'class="card-formula"': "scrolled.js",
}
"""What a page holds -> the script that it needs for it."""


def add_scripts(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Load the scripts after the page's body."""
    body = context.get("body", "")
    needed = {script for mark, script in SCRIPTS.items() if mark in body}
    for script in sorted(needed):
        address = context["pathto"](script, 1)
        context["body"] += f'<script src="{address}" defer></script>'


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", add_scripts)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
