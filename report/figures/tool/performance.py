"""The page on performance: the history of builds, its steps, and the rule that finds them."""

from __future__ import annotations

import functools
import itertools
import math
from typing import NamedTuple

import numpy as np

from bench.regression.history import log
from bench.regression.history.series import TIME, Series, series
from bench.regression.history.steps import BUILDS, RATIO, REPEATS, WINDOW, P, Step, steps
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

COMMITS = Table("Commit | Date | Benchmarks | Timed on | Steps | Steps in")

SHORT = 10
"""Digits of a commit that tell it from every other."""


class History(NamedTuple):
    """All lines as series, and each series' steps; builds are (date, commit), oldest first."""

    builds: tuple[tuple[str, str], ...]
    series: tuple[Series, ...]
    steps: tuple[Step, ...]


@functools.cache
def history(run: Run) -> History:
    """The history of this checkout."""
    lines = log.read(run.studies / "history" / log.LOG.name)
    every = tuple(series(lines))
    builds = tuple(dict.fromkeys((line.date, line.commit) for line in lines))
    return History(builds, every, tuple(step for one in every for step in steps(one)))


def facts(run: Run) -> dict:
    """What there is; the rule; how much times of the same machine code differ."""
    given = history(run)
    counted = [step for step in given.steps if step.series.measure != TIME]
    longest = max((len(one.points) for one in given.series if one.measure == TIME), default=0)
    ratios = same_code(given)
    machines = len({one.machine for one in given.series if one.machine})
    return {
        "builds": len(given.builds),
        "benchmarks": len({(one.what, one.name) for one in given.series}),
        "machines": f"{machines} machine{'' if machines == 1 else 's'}",
        "counted": len(counted),
        "timed": len(given.steps) - len(counted),
        "longest": longest,
        "wanted": count_needed_builds(),
        "repeats": f"{100.0 * REPEATS:g}\N{NO-BREAK SPACE}%",
        "fewest": BUILDS,
        "p": P,
        "tenth": f"{100.0 * (RATIO - 1.0):.0f}\N{NO-BREAK SPACE}%",
        "same_code": len(ratios),
        "noise": f"{100.0 * (np.median(ratios) - 1.0):.1f}\N{NO-BREAK SPACE}%" if ratios else html.MISSING,
        "most_noise": f"{100.0 * (max(ratios) - 1.0):.1f}\N{NO-BREAK SPACE}%" if ratios else html.MISSING,
    }


def count_needed_builds() -> int:
    """Return the fewest builds of a series among which a step can have a p below P: all before it below all from it."""
    sides = itertools.product(range(BUILDS, WINDOW + 1), repeat=2)
    return min(one + other for one, other in sides if 2.0 / math.comb(one + other, one) < P)


def same_code(given: History) -> list[float]:
    """A law's longer time over the other at neighbouring builds that have the same machine code of it."""
    pairs = (pair for one in given.series if one.measure == TIME for pair in itertools.pairwise(one.points))
    return [max(a.value, b.value) / min(a.value, b.value) for a, b in pairs if a.code == b.code != ""]


def tables(run: Run) -> dict:
    """Builds, and what they changed, newest first."""
    return {"tab_builds": COMMITS(measured(history(run)))}


def measured(given: History) -> list[tuple]:
    """A row a build: its commit, how much of it was measured, on which machines, its steps, and what they are in."""
    rows = []
    for date, name in reversed(given.builds):
        has = [one for one in given.series if any(point.commit == name for point in one.points)]
        machines = html.foreign(", ".join(dict.fromkeys(one.machine for one in has if one.machine))) or None
        own = [step.series.name for step in given.steps if step.point.commit == name]
        stepped = html.foreign(", ".join(dict.fromkeys(own))) or None
        counts = (len({(one.what, one.name) for one in has}), machines, len(own), stepped)
        rows.append((html.Html(f"<code>{html.foreign(name[:SHORT])}</code>"), html.together(date[:10]), *counts))
    return rows
