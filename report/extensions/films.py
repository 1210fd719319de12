"""Sphinx extension: a page with a film loads the script that gives it the file of the reader's theme (films.js)."""

from typing import Any

FILM = "<video data-film="


def add_script(app: Any, pagename: str, templatename: str, context: dict[str, Any], doctree: Any) -> None:
    """Load the script after the page's body."""
    if FILM in context.get("body", ""):
        address = context["pathto"]("films.js", 1)
        context["body"] += f'<script src="{address}" defer></script>'


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", add_script)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
