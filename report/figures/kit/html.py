"""The parts of a page that are not drawings: badges, tables, formulas, names of laws.

Their looks are in report/_static/report.css. Tables are Markdown, so that links and citations in their
cells are checked when the report is built; the rest is HTML.
"""

import math
import numbers
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import pandas as pd

from report.figures.kit import mathml, spelling, style

VERDICTS = {
    "holds": "holds",
    "holds with a correction": "corrected",
    "does not hold": "fails",
    "open in 1988; answered since": "answered",
    "depends on the gains": "untestable",
    "depends on how it is read": "untestable",
    "not tested": "untestable",
    "not testable": "untestable",
}
MISSING = "–"
UNTESTED = "not tested"
"""In a cell of what a run has no row of: it is neither a pass nor a failure."""

COUNT = re.compile(r"\d+ of \d+")  # a line of it alone, as 24 of 24, does not break

ROUNDED_FROM, SCIENTIFIC_FROM = 1e3, 1e9  # three figures of a number in between would read 1.23e+03
SPACED_FROM, POWER_BELOW = 10_000, 1e-3
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
    """Return a verdict as a word in its colour."""
    if verdict not in VERDICTS:
        raise ValueError(f"verdict {verdict!r} is none of ours; known: {', '.join(VERDICTS)}")
    return Html(f'<span class="verdict {VERDICTS[verdict]}">{verdict}</span>')


def law(name: str, text: str | None = None) -> Html:
    """Return the name of a regulator with the colour it has in every figure."""
    light = style.look(name).colour
    key = f'<span class="key" style="--key: {light_dark_css(light)}"></span>'
    first, space, others = escape_untrusted(text or name).partition(" ")
    return Html(f'<span class="law"><span class="together">{key}{first}</span>{space}{others}</span>')


def escape_untrusted(text: str) -> str:
    """Return a text that we did not write, for HTML and Markdown: it reads as it is, and nothing of it is markup."""
    return TAKEN.sub(lambda sign: f"&#{ord(sign[0])};", " ".join(str(text).split()))


def no_break(text: str) -> Html:
    """Return words that no table may break into lines."""
    return Html(f'<span class="together">{text}</span>')


def light_dark_css(light: str) -> str:
    """Return a colour for light and dark pages, as CSS."""
    return f"light-dark({light}, {style.TWINS[light]})"


def cell(value: Any, form: str | Callable[[Any], str] | None = None) -> str:
    """One value as it stands in a table."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return MISSING
    if callable(form):
        text = form(value)
    elif form:
        text = form.format(value) if "{" in form else format(value, form)
    elif isinstance(value, bool | str):
        text = spelling.space_thousands(str(value))
    else:
        text = number(value)
    text = spelling.spell_powers(text)
    if LEADING_MINUS.match(text):
        text = "\u2212" + text[1:]
    return text.replace("|", "\\|").replace("\n", " ")


def number(value: Any) -> str:
    """Return a number to three figures, or in full where it is whole, with thin spaces from 10,000 on.

    Below a thousandth it is a power of ten to two figures, as 9.9·10⁻⁵ and 4.1·10⁻⁴.
    """
    if not isinstance(value, numbers.Real):
        return str(value)
    value = float(value)
    if math.isinf(value):
        return "\u221e" if value > 0 else "-\u221e"
    is_whole = float(value).is_integer() or ROUNDED_FROM <= abs(value) < SCIENTIFIC_FROM
    if is_whole and abs(value) < SCIENTIFIC_FROM:
        whole = round(value)
        return f"{whole:,}".replace(",", "\u202f") if abs(whole) >= SPACED_FROM else str(whole)
    if 0.0 < abs(value) < POWER_BELOW:
        mantissa, _, exponent = f"{value:.1e}".partition("e")
        return spelling.raised(mantissa.removesuffix(".0"), int(exponent))
    return f"{value:.3g}"


def formula(tex: str) -> str:
    """TeX in a piece of HTML, on a line of its own; as it is written where it cannot be set, for a user wrote it."""
    try:
        return mathml.block(tex)
    except ValueError:
        return f'<div class="math"><code>{escape_untrusted(tex)}</code></div>'


class PageTable:
    """A table of a page, in Markdown: numbers to the right, words to the left, gaps as a dash.

        TIMES = PageTable("Law | Starts | Settled [%]:.1f | Error", {"Error": power})
        TIMES(rows)

    Args:
        columns: heads with their units, each with the format of its numbers if three figures are not what it wants.
        forms: head -> a function that writes its numbers.
        words: columns that are set as words, to the left, although they hold numbers.
    """

    def __init__(
        self, columns: str, forms: Mapping[str, Callable[[Any], str]] | None = None, words: Iterable[str] = ()
    ):
        parts = [one.strip().partition(":") for one in columns.split("|")]
        self.heads = [head for head, *_ in parts]
        self.formats = {head: form for head, _, form in parts if form} | dict(forms or {})
        self.words = tuple(words)
        if unknown := sorted(set(self.formats) - set(self.heads)):
            raise ValueError(f"formats names {unknown}, not columns of the table; known: {self.heads}")

    def __call__(self, rows: Iterable) -> Markdown | None:
        """Return the table of a frame, of mappings with these heads, or of sequences in their order; None if empty."""
        frame = pd.DataFrame(rows if isinstance(rows, pd.DataFrame) else list(rows), columns=self.heads)
        if frame.empty:
            return None
        numbers = {name for name in self.heads if pd.api.types.is_numeric_dtype(frame[name])} - set(self.words)
        rule = ["--:" if name in numbers else ":--" for name in self.heads]
        forms = [self.formats.get(head) for head in self.heads]
        lines = [self.heads, rule]
        for row in frame.itertuples(index=False, name=None):
            texts = (cell(value, form) for value, form in zip(row, forms, strict=True))
            lines.append([text.replace(" ", "\u00a0") if COUNT.fullmatch(text) else text for text in texts])
        return Markdown("\n".join(f"| {' | '.join(line)} |" for line in lines))
