"""Tables of what other libraries answered: which functions are right, which are not and where, and Euler angles."""

from __future__ import annotations

import pandas as pd

from bench.studies.libraries.forms import FORMS
from report.figures.kit import html
from report.figures.kit.spelling import power
from report.figures.libraries.libraries_rows import ANGLES, OURS, VECTOR

TAKES = {"matrix": "a matrix", "quaternion": "a quaternion"}


def right(lines: pd.DataFrame) -> pd.DataFrame:
    """The functions against which nothing is said, with their largest error anywhere."""
    kept = lines[lines["objections"].map(len).eq(0) & lines["form"].ne(ANGLES)]
    return kept.assign(largest=kept[["small", "drawn", "near", "at", "pole"]].max(axis=1))


def faulty(lines: pd.DataFrame) -> pd.DataFrame:
    """Those against which something is, angles apart."""
    return lines[lines["objections"].map(len).gt(0) & lines["form"].ne(ANGLES)]


def to_use(lines: pd.DataFrame) -> html.Markdown:
    """A row a library: its functions that are right and give the rotation vector, by what they take."""
    kept, cells = right(lines), []
    for library in dict.fromkeys(lines["library"]):
        own = kept[(kept["library"] == library) & (kept["form"] == VECTOR)]
        if library != OURS:
            by_kind = {words: _named(own[own["takes"] == word]) for word, words in TAKES.items()}
            cells.append({"Library": f"`{library}`", **{f"From {words}": one for words, one in by_kind.items()}})
    return html.table(pd.DataFrame(cells))


def _named(own: pd.DataFrame) -> str:
    """Names as code, without what the column says already."""
    names = [name.partition(", of a ")[0] for name in own["function"]]
    return "<br>".join(f"`{name}`" for name in names) or html.MISSING


def faults(lines: pd.DataFrame) -> html.Markdown:
    """A row a function against which something is said, and what."""
    cells = [
        {"Function": _asked(one), "But": "; ".join(one.objections.values())} for one in faulty(lines).itertuples()
    ]
    return html.table(pd.DataFrame(cells))


def _asked(one) -> str:
    """A line's library and function."""
    return f"{one.library} `{one.function}`"


SETS = {"small": "Small", "drawn": "Drawn", "near": "Near half turns", "at": "At them"}


def errors(lines: pd.DataFrame) -> html.Markdown:
    """A row a function, angles apart, ours among them: its largest error by its own form, by set [rad]."""
    kept = lines[lines["form"] != ANGLES]
    cells = [
        {
            "Function": _asked(one),
            "It is": html.together(FORMS[one.form].title),
            **{title: power(getattr(one, name)) for name, title in SETS.items()},
        }
        for one in kept.itertuples()
    ]
    return html.table(pd.DataFrame(cells))


def angles(lines: pd.DataFrame) -> html.Markdown:
    """A row a function that gives angles: how far the turn rebuilt is off, and they themselves as an error [rad]."""
    cells = [
        {
            "Function": _asked(one),
            "Drawn": power(one.drawn),
            "Poles": power(one.pole),
            "Half turns": power(max(one.near, one.at)),
            "As an error": f"{one.off:.1f}",
        }
        for one in lines[lines["form"] == ANGLES].itertuples()
    ]
    return html.table(pd.DataFrame(cells))


def versions(origins: dict[str, dict[str, str]]) -> html.Markdown:
    """A row a library, ours apart: what was asked, and on what."""
    cells = [
        {"Library": f"`{name}`", "Version": one["version"], "Python": one["python"], "numpy": one["numpy"]}
        for name, one in sorted(origins.items())
        if name != OURS
    ]
    return html.table(pd.DataFrame(cells))
