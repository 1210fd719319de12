"""Settling time near 180° against log10(pi - angle): a straight line whose slope the gains decide."""

import re

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.rows import MATRIX

DECADE = re.compile(r"-k(\d+)$")
FITTED = (3, 10)
"""Decades of the slope: the sine is linear in pi - angle from the first on, and rounding of R is small to the last."""


def decade(start_ids: pd.Series) -> pd.Series:
    """k of a start of the set half-turn at pi - 10^-k; missing for the exact ones."""
    return start_ids.astype(str).str.extract(DECADE, expand=False).astype(float)


def near_and_exact(rows: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Rows of the set half-turn: those at a distance from one, and those exactly on one."""
    is_near = decade(rows["start_id"]).notna()
    return rows[is_near], rows[~is_near]


def slope(rows: pd.DataFrame) -> float:
    """Seconds a decade, by least squares over the decades FITTED."""
    k = decade(rows["start_id"])
    used = k.between(*FITTED) & rows["settling_time_s"].notna()
    return float(np.polyfit(k[used], rows.loc[used, "settling_time_s"], 1)[0])


@responsive_picture
def decades(episodes: pd.DataFrame, narrow: bool):
    """Draw the settling time against the distance from 180°.

    Args:
        episodes: rows of one engine, of the rotation-matrix law and the set half-turn.
    """
    figure, axes = style.panels(height=3.9 if narrow else 3.6, narrow=narrow)
    kp, kv, tolerance = (float(episodes[name].iloc[0]) for name in ("kp", "kv", "tolerance"))
    look = style.look(MATRIX)
    k = decade(episodes["start_id"])
    near, _ = near_and_exact(episodes)
    theory = np.arange(0.0, k.max() + 0.01, 0.25)
    times = closed_form.settling_curve(kp, kv, tolerance)(10.0**-theory)
    axes.plot(theory, times, color=style.INK, linewidth=0.9, zorder=1)
    marks = {"color": look.colour, "marker": look.marker, "linestyle": "none", "markersize": 5}
    axes.plot(k[k.notna()], near["settling_time_s"], alpha=0.5, markeredgewidth=0, **marks)
    axes.set(ylim=(0, None), xlim=(-0.5, k.max() + 0.5), ylabel="settling time [s]")
    axes.set_xlabel("distance from 180°, $\\pi - \\theta$ [rad]")
    ticks = range(0, int(k.max()) + 1, 3)
    axes.set_xticks(ticks, [f"$10^{{-{one}}}$" if one else "1" for one in ticks])
    place = 0.5 * k.max()
    height = float(np.interp(place, theory, times))
    words = f"closed form, slope\n{closed_form.decade_slope(kp, kv):.4f} s a decade"
    axes.text(place + 0.5, height - 0.35, words, va="top", color=style.INK, fontsize=9.5)
    taken = near["settling_time_s"]
    return figure, (
        f"Settling time on the rotation matrix against the distance from 180°, {len(near)} starts from "
        f"1 to 1e-{k.max():.0f} rad: from {taken.min():.2f} to {taken.max():.2f} s on a straight line of "
        f"{slope(episodes):.4f} s a decade."
    )
