"""The page on impedance without inertia shaping: damping felt by mode, and the ticks from which it is unstable."""

from __future__ import annotations

import functools

import pandas as pd

from bench.experiments.impedance import ZETA
from bench.findings.theory.impedance_modes import longest_tick, with_theory
from bench.law.control.unshaped import DAMPINGS
from report.figures.arms.arm_rows import name_arm
from report.figures.kit.page import Run

BARE = "panda"
"""The arm whose model has neither hand nor rotors."""
PRACTICE = (600.0, 50.0)
"""frankapy's default on real Pandas [N/m, N m/rad], with D = 2 sqrt(K)."""


@functools.cache
def modes(run: Run) -> pd.DataFrame:
    """Return the modes measured, beside theory's."""
    return with_theory(run.rows("impedance-modes").astype({"arm": str, "damping": str}))


def facts(run: Run) -> dict:
    """Return the damping felt by each design, and where a loop is unstable."""
    found = modes(run)
    felt = {name: found.loc[found["damping"] == name, "ratio"] for name in DAMPINGS}
    double, axes = felt["double-diagonalization"], felt["per-axis"]
    lost = found[found["radius"] >= 1.0].groupby(["arm", "stiffness_n_m", "stiffness_nm_rad"]).size().index
    k, r = PRACTICE
    return {
        "felt_least": f"{felt['diagonal'].min():.2g}",
        "felt_most": f"{felt['diagonal'].max():.2g}",
        "asked": f"{found['zeta'].iloc[0]:g}",
        "double": f"{double.min():.3f} to {double.max():.3f}",
        "axis": f"{axes.min():.2g} to {axes.max():.2g}",
        "unstable": ", ".join(f"{name_arm(arm)} at {k:g} N/m, {r:g} N m/rad" for arm, k, r in lost) or "none",
        "worst_gap": f"{100 * float((found['ratio'] / found['ratio_theory'] - 1.0).abs().max()):.1g}",
        "modes": len(found),
        "slower": f"{slower(run.rows('impedance')):.2g}",
        "tick": f"{1000 * float(run.rows('impedance')['dt_s'].iloc[0]):g}",
        "practice": f"{k:g} N/m, {r:g} N m/rad",
        "practice_tick": f"{1000 * longest_tick(BARE, 'diagonal', PRACTICE, ZETA):.2g}",
    }


def slower(rows: pd.DataFrame) -> float:
    """How many times as long 2 sqrt(K) takes as double diagonalization: the median over what settles by both."""
    key = ["arm", "stiffness_n_m", "compensated", "start_id"]
    settled = rows[rows["outcome"].astype(str) == "settled"]
    wide = settled.pivot_table(index=key, columns="damping", values="settling_time_s", observed=True)
    return float((wide["diagonal"] / wide["double-diagonalization"]).median())
