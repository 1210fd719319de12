"""The history as the performance page shows it: its series in the order of the laws, its steps, its links."""

from __future__ import annotations

import functools
import re
from typing import NamedTuple

from bench.provenance import ROOT
from bench.regression.history import book
from bench.regression.history.series import MEASURES, Series, series
from bench.regression.history.steps import Step, steps
from bench.regression.revisions.measurement import LAW
from report.figures.kit import families, html

REPOSITORY = re.compile(r"""^repository-code:\s*["']?(https://[\w./-]+?)/?["']?\s*$""", re.MULTILINE)
SHORT = 10
"""Digits of a commit that tell it from every other."""


class History(NamedTuple):
    """All lines as series, and each series' steps."""

    builds: tuple[tuple[str, str], ...]
    series: tuple[Series, ...]
    steps: tuple[Step, ...]

    @property
    def machines(self) -> tuple[str, ...]:
        """Where times were taken."""
        return tuple(dict.fromkeys(one.machine for one in self.series if one.machine))

    @property
    def names(self) -> list[tuple[str, str]]:
        """(what, name) of every benchmark: laws family by family, then engines."""
        named = dict.fromkeys((one.what, one.name) for one in self.series)
        laws = families.in_order(name for what, name in named if what == LAW)
        return [*((LAW, name) for name in laws), *sorted(one for one in named if one[0] != LAW)]

    def of(self, what: str, name: str, measure: str) -> list[Series]:
        """One benchmark's series of a measure: of times one a machine."""
        return [one for one in self.series if (one.what, one.name, one.measure) == (what, name, measure)]

    def steps_of(self, one: Series) -> list[Step]:
        """The steps of a series."""
        return [step for step in self.steps if step.series is one]


@functools.cache
def history() -> History:
    """The history of this checkout; its builds are (date, commit), oldest first."""
    lines = book.read()
    every = tuple(series(lines))
    builds = tuple(dict.fromkeys((line.date, line.commit) for line in lines))
    places = {commit: at for at, (_, commit) in enumerate(builds)}
    every_step = (step for one in every for step in steps(one))
    found = sorted(every_step, key=lambda step: (places[step.point.commit], _rank(step)))
    return History(builds, every, tuple(found))


def _rank(step: Step) -> tuple[int, str]:
    return MEASURES.index(step.series.measure), step.series.name


@functools.cache
def repository() -> str:
    """Where commits can be seen, as CITATION.cff says; empty if it does not."""
    found = REPOSITORY.search((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    return found[1] if found else ""


def commit(name: str) -> html.Html:
    """A commit, leading to what it changed where that can be seen."""
    short = html.together(f"<code>{html.foreign(name[:SHORT])}</code>")
    return html.Html(f'<a href="{repository()}/commit/{html.foreign(name)}">{short}</a>' if repository() else short)
