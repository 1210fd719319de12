"""Sphinx extension: pages that need nothing from the network.

MathJax comes out of sphinx-mathjax-offline, one file of it: the stock extension copies 24 MB into the site,
while `tex-svg.js` alone (2 MB) draws every formula as outlines. It loads no font and no add-on, so pages
also work from file:// in browsers that refuse fonts there. Thebe, which jupyter-book switches on and which
would run cells on a server, is taken out, and so is what no reader loads: source maps, translations, and the icons
once more in a format for browsers before 2016.
"""

from __future__ import annotations

import importlib.metadata
import shutil
from pathlib import Path

DISTRIBUTION = "sphinx-mathjax-offline"
SCRIPT = "tex-svg.js"
AFTER_ALL_OTHERS = 999
UNREAD = ("**/*.map", "sphinx-thebe.*", "fonts/*.md", "vendor/**/*.ttf", "locales/**/*.[mp]o")


def point_at_local_copy(app, config) -> None:
    """Load the local script, and keep its context menu, which would fetch more scripts, switched off."""
    config.mathjax_path = f"mathjax/{SCRIPT}"
    ours = {"options": {"enableMenu": False}, "svg": {"fontCache": "global"}}
    for section, options in (config.mathjax3_config or {}).items():
        ours[section] = {**ours.get(section, {}), **options} if isinstance(options, dict) else options
    config.mathjax3_config = ours


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
    """Put MathJax beside the built pages and drop what no reader loads."""
    if exception or app.builder.format != "html":
        return
    static = Path(app.outdir) / "_static"
    for pattern in UNREAD:
        for unread in static.glob(pattern):
            unread.unlink()
    for file in importlib.metadata.files(DISTRIBUTION) or []:
        if file.match(f"static/mathjax/{SCRIPT}"):
            target = static / "mathjax" / SCRIPT
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(str(file.locate()), target)
            return
    raise FileNotFoundError(f"{DISTRIBUTION} ships no {SCRIPT} (cure: make setup, which installs the pinned version)")


def setup(app) -> dict:
    app.connect("config-inited", point_at_local_copy)
    app.connect("html-page-context", leave_out_thebe, priority=AFTER_ALL_OTHERS)
    app.connect("build-finished", finish, priority=AFTER_ALL_OTHERS)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
