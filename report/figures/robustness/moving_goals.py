"""The page on goals that move."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from bench.findings.theory import robustness_theory
from report.figures.kit.page import Run, given
from report.figures.robustness.bundle import Strand, bundle
from report.figures.robustness.rows import (
    DEG,
    HELD_RAD,
    along,
    gains,
    laws,
    levels,
    losses,
    medians,
    starts,
    with_unit,
    worst,
)
from report.figures.robustness.tables import by_level
from tasks.condition import RATE, RATE_AND_ACCELERATION, UNTOLD

FEEDFORWARD = {"moving-goal": RATE_AND_ACCELERATION, "moving-goal-rate": RATE, "moving-goal-untold": UNTOLD}
"""Perturbation -> what the law is given of the goal's motion."""


def theory(rows: pd.DataFrame, name: str) -> Callable[[float], float]:
    """Peak rate -> error that the linear loop has of a goal that moves little [rad]."""
    numbers = (float(rows[column].iloc[0]) for column in ("dt_s", "horizon_s"))
    gain = robustness_theory.swaying_rms(*gains(rows), FEEDFORWARD[name], *numbers)
    return lambda level: gain * level


def facts(run: Run) -> dict:
    """What is left of each kind of feedforward, by theory and in the episodes."""
    each = {name: along(run, name) for name in FEEDFORWARD}
    if any(rows.empty for rows in each.values()):
        return {}
    full, part, none = each
    kp, kv = gains(each[full])
    top = worst(each[full], full)
    slow = min(level for level in levels(each[full]) if level > 0.0)
    left = {name: DEG * medians(rows, "tail_rms_rad") for name, rows in each.items()}
    gain = {name: DEG * theory(rows, name)(1.0) for name, rows in each.items()}
    ratios = [left[name].loc[slow] / (DEG * theory(rows, name)(slow)) for name, rows in each.items()]
    return {
        "n": starts(each[full]),
        "laws": len(laws(each[full], controls=False)),
        "top": with_unit(top, full),
        "slow": with_unit(slow, full),
        "lag_s": f"{kv / kp:g}",
        "told": f"{gain[full]:.1g}",
        "rate": f"{gain[part]:.2g}",
        "untold": f"{gain[none]:.2g}",
        "ratio_low": f"{min(ratio.min() for ratio in ratios):.2f}",
        "ratio_high": f"{max(ratio.max() for ratio in ratios):.2f}",
        "told_top": f"{left[full].loc[top].median():.2g}",
        "rate_top": f"{left[part].loc[top].median():.2g}",
        "untold_top": f"{left[none].loc[top].median():.2g}",
        "lost": losses(each[full], full),
        "lag_deg": f"{DEG * kv / kp:.0f}",
        "blind": int((left[none].loc[slow] > DEG * HELD_RAD).sum()),
    }


def tables(run: Run) -> dict:
    """What is left, by level, of each kind of feedforward."""
    return {name: by_level(along(run, name), name) for name in FEEDFORWARD}


def figures(run: Run) -> dict:
    """What is left, by level, of each kind of feedforward."""

    def draw(_):
        each = {name: along(run, name) for name in FEEDFORWARD}
        return bundle([Strand(name, rows, theory(rows, name)) for name, rows in each.items()])

    return {"moving-goals": given(along(run, "moving-goal"), draw)}
