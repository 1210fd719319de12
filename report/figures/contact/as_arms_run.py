"""The page on impedance without inertia shaping: damping felt by mode, and the control periods that are stable."""

import functools
from collections.abc import Iterator

import numpy as np
import pandas as pd

from bench.experiments.impedance import Stiffness
from bench.experiments.impedance_modes import SHIPPED
from bench.experiments.suites import IDEAL_MOTORS
from bench.experiments.tables.run import Run
from bench.findings.theory.impedance_modes import (
    longest_held_tick,
    longest_tick,
    with_exact_hold,
    with_theory,
)
from bench.law.control.unshaped import DAMPINGS
from report.figures.kit import html

PANDA = html.PageTable(
    "Controller | Stiffness [N/m; N m/rad] | Longest stable control period, exact simulation [ms] "
    "| Longest stable control period in MuJoCo [ms] | Longest stable delay at 1 kHz, exact simulation [ms] "
    "| Longest stable delay at 1 kHz in MuJoCo [ms]"
)
LIMITS = ("held_dt_s", "longest_dt_s", "held_delay_s", "longest_delay_s")
"""Columns of the table's limits."""


@functools.cache
def modes(run: Run) -> pd.DataFrame:
    """Return the modes measured, beside theory's."""
    return with_theory(run.rows("impedance-modes").astype({"arm": str, "damping": str}))


def facts(run: Run) -> dict:
    """Return the damping felt by each design, and the longest stable control periods of gains shipped for Pandas."""
    every, frankapys = modes(run), SHIPPED["frankapy"]
    found, franka = driven(every), with_exact_hold(on_panda(every, frankapys))
    felt = {name: found.loc[found["damping"] == name, "ratio"] for name in DAMPINGS}
    double, axes = felt["double-diagonalization"], felt["per-axis"]
    gaps = [(found[f"{one}_theory"] / found[one] - 1.0).abs().max() for one in ("longest_dt_s", "longest_delay_s")]
    return {
        "felt_least": f"{felt['diagonal'].min():.2g}",
        "felt_most": f"{felt['diagonal'].max():.2g}",
        "asked": f"{found['zeta'].iloc[0]:g}",
        "double": f"{double.min():.3f} to {double.max():.3f}",
        "axis": f"{axes.min():.2g} to {axes.max():.2g}",
        "worst_gap": f"{100 * float((every['ratio'] / every['ratio_theory'] - 1.0).abs().max()):.1g}",
        "modes": len(every),
        "slower": f"{slower(run.rows('impedance')):.2g}",
        "tick": f"{1000 * float(run.rows('impedance')['dt_s'].iloc[0]):g}",
        "worst_limit": f"{100 * max(gaps):.1g}",
        "practice": f"{frankapys.translation:g} N/m and {frankapys.rotation:g} N m/rad",
        "practice_tick": in_ms(driven(franka)["held_dt_s"]),
        "bare_tick": f"{1000.0 * franka['held_dt_s'].min():.2g}",
        "integrator": f"{100.0 * shortened_by_integrator(zeta=1.0):.0f}",
        "panda": PANDA(limits_of_shipped(every)),
    }


def limits_of_shipped(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a controller: its limits with the least and the greatest motor inertia."""
    for name, stiffness in SHIPPED.items():
        rows = with_exact_hold(driven(on_panda(every, stiffness)))
        limits = [in_ms(rows[column]) for column in LIMITS]
        yield name, f"{stiffness.translation:g}; {stiffness.rotation:g}", *limits


def shortened_by_integrator(zeta: float) -> float:
    """Return by which share MuJoCo's limit of the period is below that of an exact hold, of one axis."""
    # Both limits are in proportion to the inverse of the frequency, so that any will do.
    frequency = 100.0
    P, Q = np.array([[frequency**2]]), np.array([[2.0 * zeta * frequency]])
    return 1.0 - longest_tick(P, Q) / longest_held_tick(P, Q)


def on_panda(every: pd.DataFrame, stiffness: Stiffness) -> pd.DataFrame:
    """Return the rows of a Panda with D = 2 sqrt(K)."""
    rows = every[(every["arm"] == "panda") & (every["damping"] == "diagonal")]
    return rows[(rows["stiffness_n_m"] == stiffness.translation) & (rows["stiffness_nm_rad"] == stiffness.rotation)]


def driven(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of arms as they are."""
    return rows[rows["variation"].astype(str) != IDEAL_MOTORS]


def in_ms(seconds: pd.Series) -> str:
    """Return the range in milliseconds."""
    return f"{1000.0 * seconds.min():.2g} to {1000.0 * seconds.max():.2g}"


def slower(rows: pd.DataFrame) -> float:
    """How many times as long 2 sqrt(K) takes as double diagonalization: the median over what settles by both."""
    key = ["arm", "stiffness_n_m", "compensated", "start_id"]
    settled = rows[rows["outcome"].astype(str) == "settled"]
    wide = settled.pivot_table(index=key, columns="damping", values="settling_time_s", observed=True)
    return float((wide["diagonal"] / wide["double-diagonalization"]).median())
