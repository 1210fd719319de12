"""What the pages on slow control, delay and inertia share: the linear loop, and the law that reverses its spring."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np
import pandas as pd

import tasks
from bench.findings.theory import robustness_theory
from report.figures.kit.inline import Picture
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table
from report.figures.robustness.level_panels import TIME, panels
from report.figures.robustness.rows import along, ends, gains, levels, nominal, of, slower, with_unit, worst
from tasks.rules import RULES

EXACT = "rotation-vector"
"""The law that is the linear loop from rest at every angle."""

PAIELLI = "paielli-bach"

REVERSAL = Table("Level | Possible from [deg]:.1f | Starts | Lost | Least angle lost [deg]:.1f")


def theory(rows: pd.DataFrame, name: str) -> Callable[[float], float]:
    """Level -> settling time of the linear loop with the rows' gains [s]."""
    settling = functools.partial(robustness_theory.settling, *gains(rows), RULES.tolerance)
    return {
        "control-rate": lambda level: settling(period_s=1.0 / level),
        "delay": lambda level: settling(delay_s=level),
        "inertia": lambda level: settling(inertia=level),
        "uneven-inertia": lambda level: max(settling(inertia=1.0 - level), settling(inertia=1.0 + level)),
    }[name]


def farthest_ms(rows: pd.DataFrame, name: str) -> float:
    """Largest difference of any start of EXACT from the linear loop's settling time [ms]."""
    own, curve = of(rows, EXACT), theory(rows, name)
    return 1000.0 * max(
        (abs(time - curve(level)) for time, level in zip(own["time_s"], own["level"], strict=True)), default=math.nan
    )


def settling_times(run: Run, name: str) -> Picture | None:
    """By level, beside the linear loop's."""
    return given(along(run, name), lambda rows: panels(rows, name, TIME, theory(rows, name)))


def facts(rows: pd.DataFrame, name: str) -> dict:
    """Of the pages on slow control and on delay."""
    curve, ratio = theory(rows, name), slower(rows, name)
    return {
        **ends(rows, name),
        "far_ms": f"{farthest_ms(rows, name):.1g}",
        "theory0": f"{curve(nominal(tasks.axis(name))):.3f}",
        "theory1": f"{curve(worst(rows, name)):.3f}",
        "least": _signed(ratio.min()),
        "most": _signed(ratio.max()),
        "within": "all of them do" if is_within(rows, name) else "not all of them do",
    }


def _signed(ratio: float) -> str:
    """A ratio as what it adds in per cent, with its sign."""
    return f"{round(100.0 * (ratio - 1.0)):+d}".replace("-", "−")


def reversal_rad(rows: pd.DataFrame, level: float, name: str) -> float:
    """Angle from which PAIELLI can turn its own spring round: by how long its first command acts before another can."""
    period = float(rows.loc[rows["level"] == level, "dt_s"].iloc[0])
    return robustness_theory.reversal_angle(gains(rows)[0], level + period if name == "delay" else period)


def reversal(rows: pd.DataFrame, name: str):
    """A level a row: angle from which PAIELLI can turn its own spring round, and the starts that it loses."""
    lines = []
    for level in levels(rows):
        own = of(rows, PAIELLI, level)
        lost = own[~own["good"]]
        least = float(np.degrees(lost["angle0_rad"].min())) if len(lost) else math.nan
        possible = math.degrees(reversal_rad(rows, level, name))
        lines.append((with_unit(level, name), possible, len(own), len(lost), least))
    return REVERSAL(lines)


def is_within(rows: pd.DataFrame, name: str) -> bool:
    """Whether every start that PAIELLI loses lies beyond the angle of its level."""
    own = of(rows, PAIELLI)
    lost = own[~own["good"]]
    return all(
        angle >= reversal_rad(own, level, name) for angle, level in zip(lost["angle0_rad"], lost["level"], strict=True)
    )
