"""The history in words: its builds, its steps, and the rule that finds them."""

from __future__ import annotations

import itertools

import numpy as np
import pandas as pd

from bench.regression.history.series import FLOPS, INSTRUCTIONS, TIME
from bench.regression.history.steps import BUILDS, OTHER_COMPILER, RATIO, REPEATS, WINDOW, P, Step
from report.figures.kit import html
from report.figures.tool.history_rows import History, commit

MEASURED = {FLOPS: "Flops", INSTRUCTIONS: "Instructions", TIME: "Time"}


def builds(given: History) -> html.Markdown:
    """A row a build, newest first: its commit, how much of it was measured, and on which machines."""
    rows = []
    for date, name in reversed(given.builds):
        has = [one for one in given.series if any(point.commit == name for point in one.points)]
        machines = dict.fromkeys(one.machine for one in has if one.machine)
        rows.append(
            {
                "Commit": commit(name),
                "Date": html.together(date[:10]),
                "Benchmarks": len({(one.what, one.name) for one in has}),
                "Timed on": html.foreign(", ".join(machines)) or None,
                "Steps": sum(step.point.commit == name for step in given.steps),
            }
        )
    return html.table(pd.DataFrame(rows, columns=["Commit", "Date", "Benchmarks", "Timed on", "Steps"]))


def steps(given: History) -> html.Markdown:
    """A row a benchmark that a build changed, newest first: from what to what, by measure."""
    found: dict[tuple[str, str], dict[str, Step]] = {}
    for step in reversed(given.steps):
        found.setdefault((step.point.commit, step.series.name), {})[step.series.measure] = step
    rows = [
        {
            "Commit": commit(at),
            "Date": html.together(next(iter(of.values())).point.date[:10]),
            "Benchmark": f"<code>{html.foreign(name)}</code>",
            **{title: changed(of.get(measure)) for measure, title in MEASURED.items()},
        }
        for (at, name), of in found.items()
    ]
    return html.table(pd.DataFrame(rows, columns=["Commit", "Date", "Benchmark", *MEASURED.values()]))


def changed(step: Step | None) -> str | None:
    """From what to what; the operations by name where flops are the same."""
    if step is None:
        return None
    if step.series.measure == TIME:
        return html.foreign(step.says)
    was, now = (html.number(round(value)) for value in (step.was, step.now))
    is_plain = was != now and not step.says.endswith(OTHER_COMPILER)
    return html.together(f"{was} → {now}") if is_plain else html.foreign(step.says)


def rule() -> dict[str, object]:
    """The numbers of the rule, as the page says them."""
    return {
        "repeats": f"{100.0 * REPEATS:g}\N{NO-BREAK SPACE}%",
        "fewest": BUILDS,
        "p": P,
        "tenth": f"{100.0 * (RATIO - 1.0):.0f}\N{NO-BREAK SPACE}%",
    }


def noise(given: History) -> dict[str, object]:
    """By how much a law's time differs between neighbouring builds that have the same machine code of it."""
    pairs = (pair for one in given.series if one.measure == TIME for pair in itertools.pairwise(one.points))
    ratios = [max(a.value, b.value) / min(a.value, b.value) for a, b in pairs if a.code == b.code != ""]
    if not ratios:
        return {"same_code": 0, "noise": html.MISSING, "most_noise": html.MISSING}
    middle, most = (f"{100.0 * (one - 1.0):.1f}\N{NO-BREAK SPACE}%" for one in (np.median(ratios), max(ratios)))
    return {"same_code": len(ratios), "noise": middle, "most_noise": most}


def counts(given: History) -> dict[str, object]:
    """What there is, in numbers and words."""
    counted = [step for step in given.steps if step.series.measure != TIME]
    longest = max((len(one.points) for one in given.series if one.measure == TIME), default=0)
    return {
        "builds": len(given.builds),
        "benchmarks": len(given.names),
        "machines": f"{len(given.machines)} machine{'' if len(given.machines) == 1 else 's'}",
        "counted": len(counted),
        "timed": len(given.steps) - len(counted),
        "longest": longest,
        "wanted": BUILDS + WINDOW,
    }
