"""The page on the perturbations that act on all laws through the linear loop that all are near the goal.

Control rate, delay, noise, inertia, initial spin and goals that move: facts of a paragraph each.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pandas as pd

import tasks
from bench.findings.perturbed import FOLLOWED_RAD
from bench.findings.theory import robustness_theory
from report.figures.kit import families
from report.figures.kit.page import Run, in_run
from report.figures.robustness.rows import (
    DEG,
    along,
    gains,
    losses,
    medians,
    nominal,
    with_unit,
    worst,
)
from tasks.condition import condition_at

TIMED = ("control-rate", "delay", "inertia", "uneven-inertia", "spin")
"""Perturbations under which laws settle."""

MOVING = ("moving-goal", "moving-goal-rate", "moving-goal-untold")


def left(rows: pd.DataFrame, name: str) -> float:
    """Root mean square angle that the linear loop keeps of noise or of a slightly moving goal [rad], over the level."""
    unit = condition_at(tasks.axis(name), 1.0)
    if unit.is_noisy:
        return robustness_theory.noisy_rms(*gains(rows), unit.period_s, unit.attitude_noise, unit.rate_noise)
    horizon_s = float(rows["horizon_s"].iloc[0])
    return robustness_theory.tracking_rms(*gains(rows), unit.feedforward, unit.period_s, horizon_s)


def over_theory(rows: pd.DataFrame, name: str) -> pd.DataFrame:
    """Return the median error over `left`: a row a level that is not zero, a column a law."""
    found = medians(rows, "tail_rms_rad")
    found = found[found.index > 0.0]
    return found.div(left(rows, name) * found.index.to_series(), axis=0)


def changes(rows: pd.DataFrame, name: str) -> dict:
    """Say by how much median settling times change at the worst level, for which law most, and who loses starts."""
    table = medians(rows)
    ratio = table.loc[worst(rows, name)] / table.loc[nominal(name)]
    ratio = 100.0 * (ratio[np.isfinite(ratio)] - 1.0)
    found = {f"{name}_worst": with_unit(worst(rows, name), name), f"{name}_losses": losses(rows, name)}
    if ratio.empty:  # no law settles at both levels
        return found
    return found | {
        f"{name}_least": f"{round(ratio.min()):+d}".replace("-", "−"),
        f"{name}_most": f"{round(ratio.max()):+d}".replace("-", "−"),
        f"{name}_law": families.word(ratio.idxmax()),
    }


def control_rate(rows: pd.DataFrame) -> dict:
    """Return the rate at which the sampled loop is unstable."""
    limit = robustness_theory.least_rate(*gains(rows))
    return {
        "limit": f"{limit:g}",
        "times": f"{worst(rows, 'control-rate') / limit:g}",
    }


def delay(rows: pd.DataFrame) -> dict:
    """Return the margin of the loop."""
    margin = robustness_theory.delay_margin(*gains(rows))
    return {
        "margin_ms": f"{1000.0 * margin:.0f}",
        "used": f"{100.0 * worst(rows, 'delay') / margin:.0f}",
    }


def noise(attitude: pd.DataFrame, rate: pd.DataFrame) -> dict:
    """Return what noise leaves, by theory and in the episodes, and what it does to the command."""
    ratios = pd.concat([over_theory(attitude, "attitude-noise"), over_theory(rate, "rate-noise")])
    return {
        "noise_low": f"{ratios.min(axis=None):.2f}",
        "noise_high": f"{ratios.max(axis=None):.2f}",
        "losses_a": losses(attitude, "attitude-noise"),
        "losses_r": losses(rate, "rate-noise"),
    }


def spin(rows: pd.DataFrame) -> dict:
    """Return how far bodies turn [deg], and whether memory sends them the longer way."""
    rows = rows.assign(turned_deg=DEG * rows["path_ratio"] * rows["angle0_rad"])
    fastest = worst(rows, "spin")
    last = rows[(rows["level"] == fastest) & rows["good"]]
    farthest = last.groupby("contender", observed=True)["turned_deg"].max()
    return {
        "coast_deg": f"{DEG * fastest / gains(rows)[1]:.0f}",
        "unwound": f"{farthest.get('quaternion-unwinding', math.nan):.0f}",
    }


def moving_goals(full: pd.DataFrame, part: pd.DataFrame, none: pd.DataFrame) -> dict:
    """Return what is left with rate and acceleration fed forward, with the rate alone, with neither."""
    kp, kv = gains(full)
    each = zip((full, part, none), MOVING, strict=True)
    ratios = pd.concat([over_theory(rows, name).iloc[:1] for rows, name in each])
    slow = float(ratios.index[0])
    return {
        "lag_s": f"{kv / kp:g}",
        "lag_deg": f"{DEG * kv / kp:.0f}",
        "moving_low": f"{ratios.min(axis=None):.2f}",
        "moving_high": f"{ratios.max(axis=None):.2f}",
        "slow": with_unit(slow, MOVING[0]),
        "top": with_unit(worst(full, MOVING[0]), MOVING[0]),
        "losses_m": losses(full, MOVING[0]),
        "laws": ratios.shape[1],
        "behind": int((medians(none, "tail_rms_rad").loc[slow] > FOLLOWED_RAD).sum()),
    }


SECTIONS: dict[Callable[..., dict], tuple[str, ...]] = {
    control_rate: ("control-rate",),
    delay: ("delay",),
    noise: ("attitude-noise", "rate-noise"),
    spin: ("spin",),
    moving_goals: MOVING,
}
"""Facts of a section -> the perturbations that it is about."""


def facts(run: Run) -> dict:
    """Return the facts of every section whose perturbations the run has."""

    def of_section(section: Callable[..., dict], names: tuple[str, ...]) -> dict:
        return section(*(along(run, name) for name in names))

    def of_times(name: str) -> dict:
        return changes(along(run, name), name)

    found: dict = {}
    for section, names in SECTIONS.items():
        found |= in_run(of_section, section, names) or {}
    for name in TIMED:
        found |= in_run(of_times, name) or {}
    return found
