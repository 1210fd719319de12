"""The page on slow control."""

import tasks
from bench.findings.theory import robustness_theory
from report.figures.kit.page import Run
from report.figures.robustness import loops
from report.figures.robustness.rows import along, gains, nominal, with_unit, worst
from report.figures.robustness.tables import usual

NAME = "control-rate"


def facts(run: Run) -> dict:
    """Of the linear loop, sampled, and of the episodes."""
    rows = along(run, NAME)
    if rows.empty:
        return {}
    limit = robustness_theory.least_rate(*gains(rows))
    return {
        **loops.facts(rows, NAME),
        "nominal": with_unit(nominal(tasks.axis(NAME)), NAME),
        "limit": f"{limit:g}",
        "times": f"{worst(rows, NAME) / limit:g}",
    }


def tables(run: Run) -> dict:
    """How it went by level, who turns its spring round, what it took."""
    rows = along(run, NAME)
    return {**usual(rows, NAME), "tab_reversal": loops.reversal(rows, NAME)}


def figures(run: Run) -> dict:
    """Settling times by level, beside the linear loop's."""
    return {NAME: loops.settling_times(run, NAME)}
