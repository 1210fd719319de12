"""Sphinx extension: pages that need nothing from the network, without what no reader loads.

Thebe, which jupyter-book switches on and which would run cells on a server, is taken out, and so are source maps and
translations.
"""

from __future__ import annotations

from pathlib import Path

AFTER_ALL_OTHERS = 999
UNREAD = ("**/*.map", "sphinx-thebe.*", "fonts/*.md", "locales/**/*.[mp]o")


def leave_out_thebe(app, pagename, templatename, context, doctree) -> None:
    """Take Thebe's scripts and style off a page."""
    for kind in ("script_files", "css_files"):
        context[kind] = [file for file in context[kind] if not is_thebe(file)]


def is_thebe(file) -> bool:
    """Whether a script or style of a page is Thebe's."""
    name = str(getattr(file, "filename", "") or "")
    body = str(getattr(file, "attributes", {}).get("body") or "")
    return "thebe" in name or "THEBE" in body


def finish(app, exception) -> None:
    """Drop from the built pages what no reader loads."""
    if exception or app.builder.format != "html":
        return
    static = Path(app.outdir) / "_static"
    for pattern in UNREAD:
        for unread in static.glob(pattern):
            unread.unlink()


def setup(app) -> dict:
    app.connect("html-page-context", leave_out_thebe, priority=AFTER_ALL_OTHERS)
    app.connect("build-finished", finish, priority=AFTER_ALL_OTHERS)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
