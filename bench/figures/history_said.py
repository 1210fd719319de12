"""The history in words: its builds, its steps, and the rule that finds them."""

from __future__ import annotations

import pandas as pd

from bench.figures import html
from bench.figures.history_rows import History, commit
from bench.history.series import FLOPS, INSTRUCTIONS, TIME
from bench.history.steps import BUILDS, RATIO, REPEATS, WINDOW, P, Step

MEASURED = {FLOPS: "operations", INSTRUCTIONS: "instructions", TIME: "time"}


def builds(given: History) -> html.Markdown:
    """A row a build, newest first: its commit, how much of it was measured, and on which machines."""
    rows = []
    for date, name in reversed(given.builds):
        has = [one for one in given.series if any(point.commit == name for point in one.points)]
        machines = dict.fromkeys(one.machine for one in has if one.machine)
        rows.append(
            {
                "Commit": commit(name),
                "Date": date[:10],
                "Benchmarks": len({(one.what, one.name) for one in has}),
                "Timed on": html.foreign(", ".join(machines)) or None,
                "Steps": sum(step.point.commit == name for step in given.steps),
            }
        )
    return html.table(pd.DataFrame(rows, columns=["Commit", "Date", "Benchmarks", "Timed on", "Steps"]))


def steps(given: History) -> html.Markdown:
    """A row for all that one build changed alike, newest first."""
    alike: dict[tuple[str, str, str], list[Step]] = {}
    for step in reversed(given.steps):
        alike.setdefault((step.point.commit, step.series.measure, step.says), []).append(step)
    rows = [
        {
            "Commit": commit(name),
            "Date": found[0].point.date[:10],
            "Benchmark": "<br>".join(f"<code>{html.foreign(one.series.name)}</code>" for one in found),
            "Of its": MEASURED[measure],
            "What changed": html.foreign(says),
        }
        for (name, measure, says), found in alike.items()
    ]
    return html.table(pd.DataFrame(rows, columns=["Commit", "Date", "Benchmark", "Of its", "What changed"]))


def rule() -> dict[str, float]:
    """The numbers of the rule, as the page says them."""
    return {
        "repeats": 100.0 * REPEATS,
        "fewest": BUILDS,
        "p": P,
        "tenth": 100.0 * (RATIO - 1.0),
    }


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
