"""How long the rotation-matrix law takes towards 180°: a straight line over decades, and nothing at 180° itself."""

import re

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run
from report.figures.kit.rows import MATRIX, of

DECADE = re.compile(r"-k(\d+)$")
FITTED = (3, 10)
"""Decades of the slope: the sine is linear in pi - angle from the first on, and rounding of R is small to the last."""


def directed(run: Run) -> pd.DataFrame:
    """Return the law's rows of the set half-turn on the continuous plant, `k` where they are 10^-k rad from it."""
    rows = of(run.rows("episodes", engine="ideal-rk4"), MATRIX, "half-turn")
    return rows.assign(k=rows["start_id"].astype(str).str.extract(DECADE, expand=False).astype(float))


def facts(run: Run) -> dict:
    """Return the time a decade, by theory and as measured, and what becomes of exact 180° rotations."""
    rows = directed(run)
    near, exact = rows[rows["k"].notna()], rows[rows["k"].isna()]
    return {
        "slope": f"{slope(near):.4f}",
        "theory": f"{closed_form.decade_slope(*rows[['kp', 'kv']].iloc[0]):.4f}",
        "closest": f"{10.0 ** -near['k'].max():.0e}",
        "longest": f"{near['settling_time_s'].max():.2f}",
        "exact": len(exact),
        "stuck": int((exact["outcome"] == "stuck").sum()),
        "horizon": float(exact["horizon_s"].max()),
        "first_k": FITTED[0],
        "last_k": FITTED[1],
    }


def figures(run: Run) -> dict:
    """Draw settling time against the distance from 180°."""
    return {"settling-decades": decades(directed(run))}


def slope(near: pd.DataFrame) -> float:
    """Seconds a decade, by least squares over the decades FITTED."""
    used = near[near["k"].between(*FITTED) & near["settling_time_s"].notna()]
    return float(np.polyfit(used["k"], used["settling_time_s"], 1)[0])


@responsive_picture
def decades(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw settling time against the distance from 180°.

    Args:
        rows: of `directed`.
    """
    figure, axes = style.panels(height=3.9 if narrow else 3.6, narrow=narrow)
    kp, kv, tolerance = rows[["kp", "kv", "tolerance"]].iloc[0]
    look, near, last = style.look(MATRIX), rows[rows["k"].notna()], int(rows["k"].max())
    theory = np.arange(0.0, last + 0.01, 0.25)
    times = closed_form.settling_curve(kp, kv, tolerance)(10.0**-theory)
    axes.plot(theory, times, color=style.INK, linewidth=0.9, zorder=1)
    marks = {"color": look.colour, "markersize": 5, "alpha": 0.5, "markeredgewidth": 0}
    axes.plot(near["k"], near["settling_time_s"], look.marker, **marks)
    axes.set(ylim=(0, None), xlim=(-0.5, last + 0.5), ylabel="settling time [s]")
    axes.set_xlabel("distance from the half turn, $\\pi - \\theta$ [rad]")
    ticks = range(0, last + 1, 3)
    axes.set_xticks(ticks, [f"$10^{{-{one}}}$" if one else "1" for one in ticks])
    words = f"closed form, slope\n{closed_form.decade_slope(kp, kv):.4f} s a decade"
    height = float(np.interp(0.5 * last, theory, times)) - 0.35
    axes.text(0.5 * last + 0.5, height, words, va="top", color=style.INK, fontsize=9.5)
    taken = near["settling_time_s"]
    return figure, (
        f"Settling time on the rotation matrix against the distance from the half turn, {len(near)} starts from "
        f"1 to 1e-{last} rad: from {taken.min():.2f} to {taken.max():.2f} s on a straight line of {slope(near):.4f} s "
        "a decade."
    )
