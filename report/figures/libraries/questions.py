"""Questions from the field: each with its thread, symptom, cause and cure, measured while the page is built."""

from __future__ import annotations

import functools
import html as escape
import textwrap

from bench.questions.picture import draw
from bench.questions.question import Curves, Found, Question, every_question, find
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run

HOST = "https://github.com"
COLUMNS = 2


@functools.cache
def answered() -> tuple[tuple[Question, Curves, Found], ...]:
    """Every question with its curves, and what they say."""
    made = [(one, one.curves()) for one in every_question().values()]
    return tuple((one, curves, find(one, curves)) for one, curves in made)


def facts(_: Run) -> dict:
    """How many there are, show their symptom, and are cured."""
    found = [found for *_, found in answered()]
    return {"asked": len(found), "shown": sum(one.shows for one in found), "cured": sum(one.cures for one in found)}


def tables(_: Run) -> dict:
    """A paragraph each."""
    return {"cases": html.Html("".join(case(one, found) for one, _, found in answered()))}


def case(one: Question, found: Found) -> str:
    """What was asked, the measured symptom, the cause, the cure and what it leaves."""
    threads = ", ".join(f'<a href="{address(thread)}">{thread.rpartition("/")[2]}</a>' for thread in one.threads)
    symptom = f"{one.y} {number(found.symptom)} at {number(found.at)} ({one.x}); right is {one.right:g}"
    words = {
        "Asked": f"{escape.escape(one.asked)} ({threads})",
        "Measured": escape.escape(symptom),
        "Cause": escape.escape(one.cause),
        "Cure": f"{escape.escape(one.cure)} Measured: {number(found.cured)}.",
    }
    entries = "".join(f"<dt>{head}</dt><dd>{text}</dd>" for head, text in words.items())
    return (
        f'<details class="claim-fold"><summary><b>{escape.escape(one.title)}</b> <code>{one.name}</code></summary>'
        f'<dl class="claim" id="{one.name}">{entries}</dl></details>'
    )


def address(thread: str) -> str:
    """owner/repository#number as a link; pull requests are found under it too."""
    repository, _, number_of = thread.partition("#")
    return f"{HOST}/{repository}/issues/{number_of}"


def number(value: float) -> str:
    """Three digits; what is no more than rounding is 0."""
    return html.number(float(f"{value:.3g}")) if abs(value) > 1e-12 else "0"


def figures(_: Run) -> dict:
    """All curves."""
    return {"questions": every_curve()}


@responsive_picture
def every_curve(narrow: bool):
    """A panel a question."""
    every = answered()
    columns = 1 if narrow else COLUMNS
    rows = -(-len(every) // columns)
    figure, axes = style.panels(rows, columns, height=2.3 * rows, narrow=narrow, squeeze=False)
    for place, (one, curves, _) in zip(axes.flat, every, strict=False):
        draw(place, one, curves, (style.COLOURS["vermillion"], style.COLOURS["green"]))
        place.set_title(textwrap.fill(f"{one.name}: {one.y}", 45))
        place.set_ylabel("")
    for place in axes.flat[len(every) :]:
        place.set_axis_off()
    shown = sum(found.shows and found.cures for *_, found in every)
    return figure, f"{len(every)} panels, one a question: {shown} symptoms that the cure takes away."
