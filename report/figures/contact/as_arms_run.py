"""The page on impedance without inertia shaping: damping felt by mode, and the control periods that are stable."""

import pandas as pd

from bench.experiments.impedance_modes import FRANKAPYS
from bench.experiments.suites import IDEAL_MOTORS
from bench.findings.theory.impedance_modes import with_theory
from bench.law.control.unshaped import DAMPINGS
from report.figures.kit.page import Run


def facts(run: Run) -> dict:
    """Return the damping felt by each design, and the longest stable control periods of frankapy's gains."""
    every = with_theory(run.rows("impedance-modes").astype({"arm": str, "damping": str}))
    driven = every["variation"].astype(str) != IDEAL_MOTORS
    found, panda = every[driven], every["arm"] == "panda"
    franka = every[panda & (every["damping"] == "diagonal") & (every["stiffness_n_m"] == FRANKAPYS.translation)]
    stable = 1000.0 * franka.loc[driven, "longest_dt_s"]
    felt = {name: found.loc[found["damping"] == name, "ratio"] for name in DAMPINGS}
    double, axes = felt["double-diagonalization"], felt["per-axis"]
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
        "practice": f"{FRANKAPYS.translation:g} N/m, {FRANKAPYS.rotation:g} N m/rad",
        "practice_tick": f"{stable.min():.2g} to {stable.max():.2g}",
        "bare_tick": f"{1000.0 * franka['longest_dt_s'].min():.2g}",
    }


def slower(rows: pd.DataFrame) -> float:
    """How many times as long 2 sqrt(K) takes as double diagonalization: the median over what settles by both."""
    key = ["arm", "stiffness_n_m", "compensated", "start_id"]
    settled = rows[rows["outcome"].astype(str) == "settled"]
    wide = settled.pivot_table(index=key, columns="damping", values="settling_time_s", observed=True)
    return float((wide["diagonal"] / wide["double-diagonalization"]).median())
