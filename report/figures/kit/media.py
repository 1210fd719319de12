"""The rendered files of report/_static/media: what they show, in numbers, and the loops as parts of pages.

report/media.py made them and wrote media.json beside them; the joint motion is an episode of our own engine.
"""

from __future__ import annotations

import html as escape
import json
from pathlib import Path

from bench.base.provenance import ROOT
from report.figures.kit import html

FOLDER = ROOT / "report" / "_static" / "media"
SOURCE = "../_static/media"
TYPES = {"webm": "video/webm", "mp4": "video/mp4"}


def facts(folder: Path = FOLDER) -> dict:
    """media.json."""
    return json.loads((folder / "media.json").read_text(encoding="utf-8"))


def loop(alt: str, name: str = "pole-loop") -> html.Html:
    """Return a loop with its poster; a reader starts it. Where no video plays, the poster stands for it."""
    words = escape.escape(alt, quote=True)
    sources = "".join(f'<source src="{SOURCE}/{name}.{kind}" type="{mime}">' for kind, mime in TYPES.items())
    poster = f"{SOURCE}/{name}.png"
    return html.Html(
        f'<video controls loop muted playsinline preload="none" poster="{poster}" width="720" height="412" '
        f'aria-label="{words}">{sources}<img src="{poster}" alt="{words}"></video>'
    )
