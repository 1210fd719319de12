"""A page's modules pasted into it, and the words where the run does not hold what the page shows.

The page pages/09-libraries.md has the module libraries/libraries.py (the front page, `index`), whose facts(run) gives
what it pastes, key by key. Further modules on a page give what it pastes under their own word: `spread` of
responses.responses is pasted as `responses.spread`. A value that is None, a key that is left out, and what needs a
table that the run lacks (NoEvidence) are not in this run, and the page says so. A key that the page does not paste is
an error.
"""

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

from bench.base.errors import NoEvidence, NoTable
from bench.experiments.tables.run import Run, shown_run
from report.figures.kit import html, spelling, style
from report.figures.kit.inline import Drawing, responsive_picture

REPORT = Path(__file__).resolve().parents[2]
ABSENT = "not in this run"
CALL = re.compile(r"^kit\.page\(([^)]*)\)$", re.MULTILINE)
INLINE = re.compile(r"\{glue:(text|md)\}`([^`:]+)")
BLOCK = re.compile(r"^\s*(?:`{3,}|:{3,})\{glue:?(md|figure|)\}\s+(\S+)", re.MULTILINE)


def in_run(make: Callable[..., Any], *arguments: Any) -> Any:
    """Return make(*arguments); None, which the page shows as not in this run, if the run lacks what it needs."""
    try:
        return make(*arguments)
    except (NoEvidence, NoTable):
        return None


def page(*names: str) -> None:
    """Paste all of a page's modules, its own first: page("responses.settling_time", "responses.responses")."""
    from myst_nb import glue

    run, text = shown_run(), text_of(names[0])
    for name in names:
        module = importlib.import_module(f"report.figures.{name}")
        for key, value in contents(module, run, text).items():
            glue(f"{word_of(module, text)}{key}", value, display=False)


def modules_of(text: str) -> list[str]:
    """Return the modules that a page pastes, its own first; none of a page without results."""
    call = CALL.search(text)
    return re.findall(r'"([\w.]+)"', call[1]) if call else []


def text_of(name: str) -> str:
    """Return the Markdown of the page that a module belongs to."""
    texts = (path.read_text(encoding="utf-8") for path in (REPORT / "index.md", *sorted(REPORT.glob("pages/*.md"))))
    (text,) = (text for text in texts if name in modules_of(text))
    return text


def contents(module: ModuleType, run: Run, text: str) -> dict[str, Any]:
    """Return what a page pastes of a module, as it pastes it, by the module's own keys."""
    found, kinds = in_run(module.facts, run) or {}, kinds_of(module, text)
    if unread := sorted(set(found) - set(kinds)):
        raise ValueError(f"{module.__name__} gives {unread}, which its page does not paste (cure: remove them)")
    return {key: as_pasted(found.get(key), kind, key) for key, kind in kinds.items()}


def kinds_of(module: ModuleType, text: str) -> dict[str, str]:
    """Return what `pasted` says of one module, by the module's own keys."""
    word = word_of(module, text)
    of_module = {key: kind for key, kind in pasted(text).items() if (key.startswith(word) if word else "." not in key)}
    return {key.removeprefix(word): kind for key, kind in of_module.items()}


def word_of(module: ModuleType, text: str) -> str:
    """Return what stands on a page before a module's keys: nothing if it is the page's own, else its word and a dot."""
    name = module.__name__.removeprefix("report.figures.")
    return f"{name.rpartition('.')[2]}." if name in modules_of(text)[1:] else ""


def pasted(text: str) -> dict[str, str]:
    """Keys that a page pastes -> fact, sentence, table, figure or piece."""
    inline = {key: "fact" if how == "text" else "sentence" for how, key in INLINE.findall(text)}
    return inline | {key: {"md": "table", "": "piece"}.get(how, how) for how, key in BLOCK.findall(text)}


def as_pasted(value: Any, kind: str, key: str) -> Any:
    """Return a fact as a word, a sentence or Markdown, a drawing unchanged; for None the words of its kind."""
    if value is None:
        return absent(key, kind)
    if kind == "fact":
        return html.cell(value)
    if kind == "sentence":
        return html.Markdown(spelling.space_thousands(value))
    return html.Markdown(value) if kind == "table" else value


def absent(key: str, kind: str) -> Any:
    """Return what stands in place of something that this run does not hold."""
    if kind == "figure":
        return blank(key.replace("-", " ").replace("_", " ").capitalize())
    if kind == "table":
        return html.PageTable("Rows")([(ABSENT,)])
    return {"fact": ABSENT, "sentence": html.Markdown(f"This is {ABSENT}.")}.get(kind, html.Html(f"<p>{ABSENT}</p>"))


@responsive_picture
def blank(what: str, narrow: bool) -> Drawing:
    """Return the words alone, in the place of a figure."""
    figure, axes = style.panels(height=0.6, narrow=narrow)
    axes.axis("off")
    said, look = f"{what}: {ABSENT}", {"color": style.MUTED, "linespacing": 1.6}
    axes.text(0.5, 0.5, said, ha="center", va="center", wrap=True, **look)
    return figure, f"{said}. The default suite holds it."
