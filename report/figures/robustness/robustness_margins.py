"""Margins of the loop far from the goal, where a law's spring is stiffer than near it; and what its own push does."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.theory import robustness_theory
from bench.findings.theory.isotropic import EQUATIONS
from report.figures.kit import families, html
from report.figures.robustness import robustness_rows

FAR_DEG = 170.0
"""Where the springs are compared: near the half turn, where the stiffest have no end."""

SIDE_RAD = 1e-5
"""Of the difference that gives the slope: its error is 1e-10 of the slope for springs that double within a radian."""

PAIELLI = "paielli-bach"


def stiffness(law: str, angle: float) -> float:
    """Slope of a law's spring at an angle [rad], of a law with a scalar equation: 1 near the goal."""
    spring = EQUATIONS[law].spring
    return (spring(angle + SIDE_RAD) - spring(angle - SIDE_RAD)) / (2.0 * SIDE_RAD)


def table(rows: pd.DataFrame) -> html.Markdown:
    """A law a row: stiffness near the half turn, delay margin and least control rate there; and near the goal.

    Args:
        rows: of `robustness_rows.along`.
    """
    kp, kv = robustness_rows.gains(rows)
    lines = [_line("every law, near the goal", 1.0, kp, kv)]
    for law in robustness_rows.laws(rows):
        if law in EQUATIONS and law not in families.CONTROLS:
            lines.append(_line(families.link(law, families.word(law)), stiffness(law, math.radians(FAR_DEG)), kp, kv))
    return html.table(pd.DataFrame(lines), {"Stiffness": ".3g", "Delay margin [ms]": ".0f", "Least rate [Hz]": ".3g"})


def _line(name: str, slope: float, kp: float, kv: float) -> dict:
    pulls = slope > 0.0
    return {
        "Law": name,
        "Stiffness": slope,
        "Delay margin [ms]": 1000.0 * robustness_theory.delay_margin(kp, kv, slope) if pulls else math.nan,
        "Least rate [Hz]": robustness_theory.least_rate(kp, kv, slope) if pulls else math.nan,
    }


def blind_s(rows: pd.DataFrame, level: float, name: str) -> float:
    """How long a law's first command from rest acts before another, that knows of the motion, can [s]."""
    period = float(rows.loc[rows["level"] == level, "dt_s"].iloc[0])
    return level + period if name == "delay" else period


def reversal(rows: pd.DataFrame, name: str) -> html.Markdown:
    """A level a row: angle from which paielli-bach can turn its own spring round, and the starts that it loses.

    Args:
        rows: of `robustness_rows.along`. name: control-rate or delay.
    """
    lines = []
    kp, _ = robustness_rows.gains(rows)
    for level in robustness_rows.levels(rows):
        own = robustness_rows.of(rows, PAIELLI, level)
        lost = own[~own["good"]]
        lines.append(
            {
                "Level": robustness_rows.said(level, name),
                "Possible from [deg]": math.degrees(robustness_theory.reversal_angle(kp, blind_s(own, level, name))),
                "Starts": len(own),
                "Lost": len(lost),
                "Least angle lost [deg]": float(np.degrees(lost["angle0_rad"].min())) if len(lost) else math.nan,
            }
        )
    return html.table(pd.DataFrame(lines), {"Possible from [deg]": ".1f", "Least angle lost [deg]": ".1f"})


def is_within(rows: pd.DataFrame, name: str) -> bool:
    """Whether every start that paielli-bach loses lies beyond the angle of its level."""
    kp, _ = robustness_rows.gains(rows)
    lost = robustness_rows.of(rows, PAIELLI)
    lost = lost[~lost["good"]]
    return all(
        angle >= robustness_theory.reversal_angle(kp, blind_s(lost, level, name))
        for angle, level in zip(lost["angle0_rad"], lost["level"], strict=True)
    )
