"""Sphinx extension: MathJax out of sphinx-mathjax-offline, one file of it.

The stock extension copies 24 MB into the site. `tex-svg.js` alone (2 MB) draws every formula as outlines: it loads no
font and no add-on, so pages also work from file:// in browsers that refuse fonts there.
"""

from __future__ import annotations

import importlib.metadata
import shutil
from pathlib import Path

DISTRIBUTION = "sphinx-mathjax-offline"
SCRIPT = "tex-svg.js"


def point_at_local_copy(app, config) -> None:
    """Load the local script, and keep its context menu, which would fetch more scripts, switched off."""
    config.mathjax_path = f"mathjax/{SCRIPT}"
    ours = {"options": {"enableMenu": False}, "svg": {"fontCache": "global"}}
    for section, options in (config.mathjax3_config or {}).items():
        ours[section] = {**ours.get(section, {}), **options} if isinstance(options, dict) else options
    config.mathjax3_config = ours


def copy_script(app, exception) -> None:
    """Put the script beside the built pages."""
    if exception or app.builder.format != "html":
        return
    for file in importlib.metadata.files(DISTRIBUTION) or []:
        if file.match(f"static/mathjax/{SCRIPT}"):
            target = Path(app.outdir) / "_static" / "mathjax" / SCRIPT
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(str(file.locate()), target)
            return
    raise FileNotFoundError(f"{DISTRIBUTION} ships no {SCRIPT} (cure: make setup, which installs the pinned version)")


def setup(app) -> dict:
    app.connect("config-inited", point_at_local_copy)
    app.connect("build-finished", copy_script)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
