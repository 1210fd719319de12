"""Laws with a state of their own: what they leave under a constant disturbance, and what they need to measure."""

from __future__ import annotations

import math

import pandas as pd

from bench.law.contenders.registry import contenders
from bench.law.inputs import PAPERS_GAINS
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

STATES = Table("Law | Measures the rate | Disturbance [rad/s²]:g | Left [°]:.2f | Within 1° [s] | Slowest [s]")


def compensated(run: Run) -> pd.DataFrame:
    """Rows, words as text."""
    return run.rows("compensators").astype({"law": str, "reads_rate": str})


def facts(run: Run) -> dict:
    """Return what laws without an integral leave; how long the law without a rate takes over its twin."""
    rows = compensated(run)
    worst = rows["disturbance"].max()
    rejecting = {name for name, one in contenders("compensators").items() if one.state.rejects}
    left = rows[(rows["disturbance"] == worst) & ~rows["law"].isin(rejecting)]["left_rad"].max()
    still = rows[rows["disturbance"] == 0.0]
    without = still.loc[still["reads_rate"] == "no", "settling_median_s"].iloc[0]
    paper = still.loc[~still["law"].isin(contenders("compensators")), "settling_median_s"].iloc[0]
    return {
        "left": f"{math.degrees(left):.1f}",
        "disturbance": f"{worst:g}",
        "starts": int(rows["starts"].max()),
        "faster": f"{without / paper:.2f}",
        "fast_gain": f"{PAPERS_GAINS.kp + 2.0 * PAPERS_GAINS.kv**2:g}",
        "slow_gain": f"{PAPERS_GAINS.kp:g}",
    }


def tables(run: Run) -> dict:
    """Return a row a law and disturbance."""
    return {
        "states": STATES(
            (
                _title(one.law),
                one.reads_rate,
                one.disturbance,
                math.degrees(one.left_rad),
                *(_seconds(value) for value in (one.settling_median_s, one.settling_worst_s)),
            )
            for one in compensated(run).itertuples()
        )
    }


def _title(law: str) -> str:
    known = {**contenders("regulators"), **contenders("compensators")}
    return known[law].title if law in known else law


def _seconds(value: float) -> str:
    return html.MISSING if math.isnan(value) else f"{value:.2f}"
