"""What the page on settling times shows: numbers of the three laws, and the rotation matrix towards 180°."""

import functools
import math
import re

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.kit import style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run
from report.figures.kit.rows import MATRIX, SHORT, of

DECADE = re.compile(r"-k(\d+)$")
FITTED = (3, 10)
"""Decades of the slope: the sine is linear in pi - angle from the first on, and rounding of R is small to the last."""


@functools.cache
def continuous(run: Run) -> pd.DataFrame:
    """Episodes on the continuous plant."""
    return run.rows("episodes", engine="ideal-rk4")


def facts(run: Run) -> dict:
    """Return settling near zero, against the angle by law, and towards 180°."""
    episodes = continuous(run)
    kp, kv, tolerance = (float(episodes[name].iloc[0]) for name in ("kp", "kv", "tolerance"))
    near, exact = near_and_exact(of(episodes, MATRIX, "half-turn"))
    late = late_ms(of(episodes, MATRIX), kp, kv, tolerance)
    values = {
        "band": f"{100 * tolerance:g}",
        "rtol": f"{closed_form.TIGHT['rtol']:.0e}",
        "linear": f"{closed_form.linear_settling(kp, kv, tolerance):.4f}",
        "n": len(late),
        "early": f"{late.min():.2f}",
        "late": f"{late.max():.2f}",
        "slope": f"{slope(near):.4f}",
        "theory": f"{closed_form.decade_slope(kp, kv):.4f}",
        "closest": f"{10.0 ** -decade(near['start_id']).max():.0e}",
        "longest": f"{near['settling_time_s'].max():.2f}",
        "exact": len(exact),
        "stuck": int((exact["outcome"] == "stuck").sum()),
        "horizon": float(exact["horizon_s"].max()),
        "first_k": FITTED[0],
        "last_k": FITTED[1],
    }
    for letter, name in SHORT.items():
        times = of(episodes, name)["settling_time_s"]
        values |= {f"median_{letter}": f"{times.median():.3f}", f"worst_{letter}": f"{times.max():.3f}"}
    return values


def figures(run: Run) -> dict:
    """Draw settling time against the distance from 180°."""
    return {"settling-decades": decades(of(continuous(run), MATRIX, "half-turn"))}


def late_ms(rows: pd.DataFrame, kp: float, kv: float, tolerance: float) -> pd.Series:
    """Measured settling time minus its closed form [ms], for rows of the rotation-matrix law at rest."""
    theory = closed_form.settling_curve(kp, kv, tolerance)(math.pi - rows["angle0_rad"].to_numpy())
    return 1000.0 * (rows["settling_time_s"] - theory)


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
def decades(episodes: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw settling time against the distance from 180°.

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
    axes.set_xlabel("distance from the half turn, $\\pi - \\theta$ [rad]")
    ticks = range(0, int(k.max()) + 1, 3)
    axes.set_xticks(ticks, [f"$10^{{-{one}}}$" if one else "1" for one in ticks])
    place = 0.5 * k.max()
    height = float(np.interp(place, theory, times))
    words = f"closed form, slope\n{closed_form.decade_slope(kp, kv):.4f} s a decade"
    axes.text(place + 0.5, height - 0.35, words, va="top", color=style.INK, fontsize=9.5)
    taken = near["settling_time_s"]
    return figure, (
        f"Settling time on the rotation matrix against the distance from the half turn, {len(near)} starts from "
        f"1 to 1e-{k.max():.0f} rad: from {taken.min():.2f} to {taken.max():.2f} s on a straight line of "
        f"{slope(episodes):.4f} s a decade."
    )
