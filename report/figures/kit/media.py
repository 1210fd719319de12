"""The rendered files that report/media.py made: what media.json says they show, and the loops as parts of pages."""

import html as escape
import json
from collections.abc import Callable
from pathlib import Path

from bench.base.provenance import ROOT
from report.figures.kit import html

FOLDER = ROOT / "report" / "_static" / "media"
SOURCE = "../_static/media"
TYPES = {"webm": "video/webm", "mp4": "video/mp4"}


def facts(folder: Path = FOLDER) -> dict:
    """media.json."""
    return json.loads((folder / "media.json").read_text(encoding="utf-8"))


def loop(alt: str, name: str = "pole-loop", source: str = SOURCE, height: int = 412) -> html.Html:
    """Return a loop, whose script (report/_extra/films.js) loads the file of the page's theme and plays it.

    Where no script runs, a reader starts the light one. Where no video plays, the poster stands for it.
    """
    words, file = escape.escape(alt, quote=True), f"{source}/{name}"
    shown = f'loop muted playsinline preload="none" width="720" height="{height}" aria-label="{words}"'
    sources = "".join(f'<source src="{file}.{kind}" type="{mime}">' for kind, mime in TYPES.items())
    poster = f'<img src="{file}.png" alt="{words}">'
    without_script = f'<video controls poster="{file}.png" {shown}>{sources}{poster}</video>'
    return html.Html(f'<video data-film="{file}" {shown} hidden></video><noscript>{without_script}</noscript>')


def still(alt: str, name: str) -> html.Html:
    """Return a rendered picture."""
    words = escape.escape(alt, quote=True)
    return in_both_themes(lambda file, shown: f'<img class="{shown}" src="{file}.png" alt="{words}">', name)


def in_both_themes(write: Callable[[str, str], str], name: str, source: str = SOURCE) -> html.Html:
    """Return the files of light pages and of dark ones, each shown where its class says."""
    shown = (("", "only-light"), ("-dark", "only-dark"))
    return html.Html("".join(write(f"{source}/{name}{suffix}", where) for suffix, where in shown))
