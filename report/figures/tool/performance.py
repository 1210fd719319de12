"""The page on performance: the history of builds, its steps, and the rule that finds them."""

from __future__ import annotations

import functools
import itertools
import re

import numpy as np

from bench.provenance import ROOT
from bench.regression.history.series import FLOPS, INSTRUCTIONS, TIME
from bench.regression.history.steps import BUILDS, OTHER_COMPILER, RATIO, REPEATS, WINDOW, P, Step
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table
from report.figures.tool.history import SHORT, History, chart, history

REPOSITORY = re.compile(r"""^repository-code:\s*["']?(https://[\w./-]+?)/?["']?\s*$""", re.MULTILINE)

COMMITS = Table("Commit | Date | Benchmarks | Timed on | Steps")
STEPS = Table("Commit | Date | Benchmark | Flops | Instructions | Time")


@functools.cache
def repository() -> str:
    """Where commits can be seen, as CITATION.cff says; empty if it does not."""
    found = REPOSITORY.search((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    return found[1] if found else ""


def commit(name: str) -> html.Html:
    """A commit, leading to what it changed where that can be seen."""
    short = html.together(f"<code>{html.foreign(name[:SHORT])}</code>")
    return html.Html(f'<a href="{repository()}/commit/{html.foreign(name)}">{short}</a>' if repository() else short)


def facts(_: Run) -> dict:
    """What there is; the rule; how much times of the same machine code differ."""
    given = history()
    counted = [step for step in given.steps if step.series.measure != TIME]
    longest = max((len(one.points) for one in given.series if one.measure == TIME), default=0)
    ratios = same_code(given)
    return {
        "builds": len(given.builds),
        "benchmarks": len(given.names),
        "machines": f"{len(given.machines)} machine{'' if len(given.machines) == 1 else 's'}",
        "counted": len(counted),
        "timed": len(given.steps) - len(counted),
        "longest": longest,
        "wanted": BUILDS + WINDOW,
        "repeats": f"{100.0 * REPEATS:g}\N{NO-BREAK SPACE}%",
        "fewest": BUILDS,
        "p": P,
        "tenth": f"{100.0 * (RATIO - 1.0):.0f}\N{NO-BREAK SPACE}%",
        "same_code": len(ratios),
        "noise": f"{100.0 * (np.median(ratios) - 1.0):.1f}\N{NO-BREAK SPACE}%" if ratios else html.MISSING,
        "most_noise": f"{100.0 * (max(ratios) - 1.0):.1f}\N{NO-BREAK SPACE}%" if ratios else html.MISSING,
    }


def same_code(given: History) -> list[float]:
    """A law's longer time over the other at neighbouring builds that have the same machine code of it."""
    pairs = (pair for one in given.series if one.measure == TIME for pair in itertools.pairwise(one.points))
    return [max(a.value, b.value) / min(a.value, b.value) for a, b in pairs if a.code == b.code != ""]


def tables(_: Run) -> dict:
    """Builds, and what they changed, newest first."""
    return {"tab_builds": COMMITS(measured(history())), "tab_steps": STEPS(stepped(history()))}


def measured(given: History) -> list[tuple]:
    """A row a build: its commit, how much of it was measured, on which machines, and its steps."""
    rows = []
    for date, name in reversed(given.builds):
        has = [one for one in given.series if any(point.commit == name for point in one.points)]
        machines = html.foreign(", ".join(dict.fromkeys(one.machine for one in has if one.machine))) or None
        count = sum(step.point.commit == name for step in given.steps)
        rows.append(
            (commit(name), html.together(date[:10]), len({(one.what, one.name) for one in has}), machines, count)
        )
    return rows


def stepped(given: History) -> list[tuple]:
    """A row a benchmark that a build changed: from what to what, by measure."""
    found: dict[tuple[str, str], dict[str, Step]] = {}
    for step in reversed(given.steps):
        found.setdefault((step.point.commit, step.series.name), {})[step.series.measure] = step
    return [
        (
            commit(at),
            html.together(next(iter(of.values())).point.date[:10]),
            f"<code>{html.foreign(name)}</code>",
            *(changed(of.get(measure)) for measure in (FLOPS, INSTRUCTIONS, TIME)),
        )
        for (at, name), of in found.items()
    ]


def changed(step: Step | None) -> str | None:
    """From what to what; the operations by name where flops are the same."""
    if step is None:
        return None
    if step.series.measure == TIME:
        return html.foreign(step.says)
    was, now = (html.number(round(value)) for value in (step.was, step.now))
    is_plain = was != now and not step.says.endswith(OTHER_COMPILER)
    return html.together(f"{was} → {now}") if is_plain else html.foreign(step.says)


def figures(_: Run) -> dict:
    """Every series about its latest value."""
    return {"history": chart(history()) if history().builds else None}
