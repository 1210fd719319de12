"""How long the rotation-matrix law takes towards 180°: a straight line over decades, and nothing at 180° itself."""

import re

import numpy as np
import pandas as pd

from bench.experiments.tables.run import Run
from bench.findings.theory import closed_form
from report.figures.kit.laws import MATRIX
from report.figures.kit.spelling import power

DECADE = re.compile(r"-k(\d+)$")  # of a start that is 10^-k rad from 180°
FITTED = (3, 10)
"""Decades of the slope: the sine is linear in pi - angle from the first on, and rounding of R is small to the last."""


def facts(run: Run) -> dict:
    """Return the time a decade, by theory and as measured, and what becomes of exact 180° rotations."""
    rows = run.rows("episodes", engine="ideal-rk4", contender=MATRIX, start_set="half-turn")
    rows = rows.assign(k=rows["start_id"].astype(str).str.extract(DECADE, expand=False).astype(float))
    near, exact = rows[rows["k"].notna()], rows[rows["k"].isna()]
    used = near[near["k"].between(*FITTED) & near["settling_time_s"].notna()]
    return {
        "slope": f"{np.polyfit(used['k'], used['settling_time_s'], 1)[0]:.4f}",
        "theory": f"{closed_form.decade_slope(*rows[['kp', 'kv']].iloc[0]):.4f}",
        "closest": power(10.0 ** -near["k"].max()),
        "longest": f"{near['settling_time_s'].max():.2f}",
        "stuck": count_stuck(exact),
        "horizon": float(exact["horizon_s"].max()),
    }


def count_stuck(exact: pd.DataFrame) -> str:
    """Say how many of the starts at exactly 180° never move."""
    stuck = int((exact["outcome"] == "stuck").sum())
    return f"all {stuck}" if stuck == len(exact) else f"{stuck} of {len(exact)}"
