"""The parts of a page that are not drawings: badges, tables, tiles, the card of a law, a ball to turn.

Their looks are in report/_static/report.css. Tables are Markdown, so that links and citations in their
cells are checked when the report is built; the rest is HTML.
"""

from __future__ import annotations

import html
import json
import math
import numbers
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import pandas as pd

from report.figures.kit import style
from report.figures.kit.inline import Picture

VERDICTS = {
    "holds": "holds",
    "holds with a correction": "corrected",
    "does not hold": "fails",
    "not yet measured": "unmeasured",
}
MISSING = "–"
ROUNDED_FROM, SCIENTIFIC_FROM = 1e3, 1e9  # three figures of a number in between would read 1.23e+03
LEADING_MINUS = re.compile(r"-[\d.\u221e]")
TAKEN = re.compile(r"[&<>\"'\\$`*_{}\[\]|~#!^@]")
"""What HTML, Markdown, MyST or TeX take for their own."""


class Html(str):
    """A piece of HTML; as the last value of a cell it becomes part of the page."""

    def _repr_html_(self) -> str:
        return str(self)


class Markdown(str):
    """A piece of Markdown, to be glued and pasted as `{glue:md}`."""

    def _repr_markdown_(self) -> str:
        return str(self)


def badge(verdict: str) -> Html:
    """A verdict as a word in its colour."""
    if verdict not in VERDICTS:
        raise ValueError(f"verdict {verdict!r} is none of ours; known: {', '.join(VERDICTS)}")
    return Html(f'<span class="verdict {VERDICTS[verdict]}">{verdict}</span>')


def outcome(name: str) -> Html:
    """An outcome with the colour it has in every failure map."""
    light = style.OUTCOMES[name][0]
    return Html(f'<span class="key" style="--key: {both(light)}"></span>{name}')


def law(name: str, text: str | None = None) -> Html:
    """The name of a regulator with the colour it has in every figure."""
    light = style.look(name).colour
    key = f'<span class="key" style="--key: {both(light)}"></span>'
    return Html(f'<span class="law">{key}{foreign(text or name)}</span>')


def foreign(text: str) -> str:
    """A text that we did not write, for HTML and for Markdown: it reads as it is, and nothing of it is markup.

    An entity is a letter to Markdown; MathJax, which looks for \\( and $$ in the finished page, is stopped by a word
    joiner, which has no width.
    """

    def spelled(sign: re.Match) -> str:
        return f"&#{ord(sign[0])};" + ("&#8288;" if sign[0] in "\\$" else "")

    return TAKEN.sub(spelled, " ".join(str(text).split()))


def together(text: str) -> Html:
    """Words that no table may break into lines."""
    return Html(f'<span class="together">{text}</span>')


def both(light: str) -> str:
    """A colour for light and dark pages, as CSS."""
    return f"light-dark({light}, {style.TWINS[light]})"


def table(
    frame: pd.DataFrame, formats: Mapping[str, str | Callable[[Any], str]] | None = None, words: Iterable[str] = ()
) -> Markdown:
    """A frame as a Markdown table: numbers to the right, words to the left, gaps as a dash.

    Args:
        frame: one row per line of the table; the column labels are its head, the index is left out.
        formats: per column ".2f", "{:.2f} s" or a function; without one, `number`.
        words: columns to set as words although they hold numbers.
    """
    formats = dict(formats or {})
    unknown = sorted(set(formats) - set(map(str, frame.columns)))
    if unknown:
        raise ValueError(f"formats names {unknown}, not columns of the table; known: {list(map(str, frame.columns))}")
    as_words = {str(name) for name in frame if not pd.api.types.is_numeric_dtype(frame[name])} | set(words)
    head = [str(column) for column in frame.columns]
    rule = [":--" if column in as_words else "--:" for column in head]
    rows = [
        [cell(value, formats.get(column)) for column, value in zip(head, row, strict=True)]
        for row in frame.itertuples(index=False, name=None)
    ]
    lines = [head, rule, *rows]
    return Markdown("\n".join("| " + " | ".join(line) + " |" for line in lines))


def cell(value: Any, form: str | Callable[[Any], str] | None = None) -> str:
    """One value as it stands in a table."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return MISSING
    if callable(form):
        text = form(value)
    elif form:
        text = form.format(value) if "{" in form else format(value, form)
    elif isinstance(value, bool | str):
        text = str(value)
    else:
        text = number(value)
    if LEADING_MINUS.match(text):
        text = "\u2212" + text[1:]
    return text.replace("|", "\\|").replace("\n", " ")


def number(value: Any) -> str:
    """A number to three figures, or in full where it is whole, with thin spaces between thousands."""
    if not isinstance(value, numbers.Real):
        return str(value)
    value = float(value)
    if math.isinf(value):
        return "\u221e" if value > 0 else "-\u221e"
    is_whole = float(value).is_integer() or ROUNDED_FROM <= abs(value) < SCIENTIFIC_FROM
    if is_whole and abs(value) < SCIENTIFIC_FROM:
        return f"{round(value):,}".replace(",", "\u202f")
    return f"{value:.3g}"


def tiles(entries: Sequence[tuple[Any, str] | tuple[Any, str, str]]) -> Html:
    """The front page's numbers: (value, what it is) or (value, what it is, verdict whose colour it takes)."""
    parts = []
    for value, label, *verdict in entries:
        tone = VERDICTS[verdict[0]] if verdict else "plain"
        parts.append(f'<div class="tile {tone}"><b>{cell(value)}</b><span>{html.escape(label)}</span></div>')
    return Html(f'<div class="tiles">{"".join(parts)}</div>')


def formula(tex: str) -> str:
    """TeX in a piece of HTML, set by the page's MathJax."""
    return f'<span class="math notranslate nohighlight">\\[{html.escape(tex)}\\]</span>'


def card(
    name: str,
    title: str,
    tex: str,
    source: str,
    summary: str,
    costs: pd.DataFrame | None = None,
    picture: Picture | None = None,
    fails: str = "",
    facts: Mapping[str, str] | None = None,
    anchor: str = "",
    response: Picture | None = None,
    strip: str = "",
) -> Html:
    """The card of a law, drawn wholly from what its module and its results say.

    Args:
        name: the contender, which decides the colour.
        title: how it is called in prose.
        tex: its formula, in TeX without dollars.
        source: where it was published, with equation numbers.
        summary: a sentence on what it does.
        costs: operations by stage, one row a stage; whole numbers.
        picture: its failure map.
        fails: a sentence on where it fails, in numbers.
        facts: more such sentences by their first word, "Measured" say.
        anchor: makes the title a heading of the page that links can name.
        response: what stands under the map.
        strip: a piece of HTML over the whole width, below.
    """
    left = [f"<p>{foreign(summary)}</p>"]
    said = {**({"Fails": fails} if fails else {}), **(facts or {})}
    left += [f'<p class="card-fact"><b>{label}.</b> {foreign(text)}</p>' for label, text in said.items()]
    if costs is not None:
        left.append(f'<div class="card-costs" tabindex="0">{plain_table(costs)}</div>')
    drawn = "".join(one._repr_html_() for one in (picture, response) if one)
    right = f'<div class="card-map">{drawn}</div>' if drawn else ""
    name_of = foreign(title)
    formula_line = f'<div class="card-formula">{formula(tex)}</div>' if tex else ""
    heading = f'<h2 id="{anchor}">{name_of}</h2>' if anchor else f"<strong>{name_of}</strong>"
    return Html(
        f'<section class="law-card{"" if drawn else " alone"}" '
        f'style="--law: {both(style.look(name).colour)}" '
        f'aria-label="{html.escape(title, quote=True)}">'
        f"<header>{heading}"
        f'<span class="card-source">{foreign(source)}</span></header>'
        f"{formula_line}"
        f'<div class="card-body"><div class="card-text">{"".join(left)}</div>{right}</div>{strip}</section>'
    )


def plain_table(frame: pd.DataFrame) -> str:
    """A small HTML table for inside a card; the first column is words."""
    head = "".join(f'<th scope="col">{html.escape(str(column))}</th>' for column in frame.columns)
    rows = "".join(
        "<tr>" + "".join(f"<td>{html.escape(cell(value))}</td>" for value in row) + "</tr>"
        for row in frame.itertuples(index=False, name=None)
    )
    return f'<table class="plain"><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>'


def ball(name: str, alt: str, points: Mapping[str, Any], radius_label: str = "π") -> Html:
    """A ball of rotation vectors that the reader turns; the page loads `_extra/ball.js` to draw it.

    Args:
        name: unique on its page; the canvas's id is `ball-` and this.
        alt: what it shows, in words.
        points: label -> {"colour": light, "dark": dark, "xyz": [[x, y, z], ...]} with xyz in the unit ball.
        radius_label: what the surface of the ball stands for.
    """
    data = json.dumps({"groups": points, "radius": radius_label}, separators=(",", ":")).replace("<", "\\u003c")
    words = html.escape(alt, quote=True)
    return Html(
        f'<canvas class="ball" id="ball-{name}" tabindex="0" role="img" aria-label="{words}"></canvas>'
        f'<script type="application/json" data-for="ball-{name}">{data}</script>'
        '<p class="hint">Drag, or use the arrow keys, to turn. Double click to start over.</p>'
    )
