"""The page on delay, and on the margins of the loop far from the goal, where a law's spring is stiffer than near it."""

from __future__ import annotations

import math

import pandas as pd

from bench.findings.theory import robustness_theory
from bench.findings.theory.isotropic import EQUATIONS
from report.figures.kit import families, html
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table
from report.figures.robustness import loops
from report.figures.robustness.rows import DEG, along, gains, laws, worst
from report.figures.robustness.tables import usual

NAME = "delay"

FAR_DEG = 170.0
"""Where the springs are compared: near the half turn, where the stiffest have no end."""

SIDE_RAD = 1e-5
"""Of the difference that gives the slope: its error is 1e-10 of the slope for springs that double within a radian."""

MARGINS = Table("Law | Stiffness:.3g | Delay margin [ms]:.0f | Least rate [Hz]:.3g")


def stiffness(law: str, angle: float) -> float:
    """Slope of a law's spring at an angle [rad], of a law with a scalar equation: 1 near the goal."""
    spring = EQUATIONS[law].spring
    return (spring(angle + SIDE_RAD) - spring(angle - SIDE_RAD)) / (2.0 * SIDE_RAD)


def margins(rows: pd.DataFrame) -> html.Markdown | None:
    """A law a row: stiffness near the half turn, delay margin and least control rate there; and near the goal."""
    own = [law for law in laws(rows, controls=False) if law in EQUATIONS]
    slopes: dict[str, float] = {"every law, near the goal": 1.0}
    slopes |= {families.link(law, families.word(law)): stiffness(law, math.radians(FAR_DEG)) for law in own}
    lines = []
    for name, slope in slopes.items():
        loop = (*gains(rows), slope)
        found = (1000.0 * robustness_theory.delay_margin(*loop), robustness_theory.least_rate(*loop))
        lines.append((name, slope, *(found if slope > 0.0 else (math.nan, math.nan))))
    return MARGINS(lines)


def facts(run: Run) -> dict:
    """Of the linear loop with the delay, and of the episodes."""
    rows = along(run, NAME)
    if rows.empty:
        return {}
    kp, kv = gains(rows)
    margin = robustness_theory.delay_margin(kp, kv)
    return {
        **loops.facts(rows, NAME),
        "crossover": f"{robustness_theory.crossover(kp, kv):.1f}",
        "phase": f"{DEG * robustness_theory.phase_margin(kp, kv):.0f}",
        "delay_ms": f"{1000.0 * margin:.0f}",
        "used": f"{100.0 * worst(rows, NAME) / margin:.0f}",
    }


def tables(run: Run) -> dict:
    """How it went by level, margins, who turns its spring round, what it took."""
    rows = along(run, NAME)
    return {
        **usual(rows, NAME),
        "tab_margins": given(rows, margins),
        "tab_reversal": loops.reversal(rows, NAME),
    }


def figures(run: Run) -> dict:
    """Settling times by level, beside the linear loop's."""
    return {NAME: loops.settling_times(run, NAME)}
