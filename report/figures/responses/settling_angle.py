"""Settling time against angle: the three laws' bands, and how far the rotation-matrix law is from its closed form."""

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.kit import laws, style
from report.figures.kit.dots import dots
from report.figures.kit.inline import responsive_picture

BIN_DEG = 10
FEWEST = 5
"""A bin of fewer starts says nothing about its quantiles."""

LOW, MIDDLE, HIGH = 0.05, 0.5, 0.95
DRAWN = 1000
TOP_S = 1.8


@responsive_picture
def bands(episodes: pd.DataFrame, narrow: bool):
    """Median and 5 to 95 % of settling time by angle; below, measured minus closed form for the rotation-matrix law.

    Args:
        episodes: rows of one engine and of the set uniform; what does not settle has no time and is left out.
    """
    figure, (upper, lower) = style.panels(
        2, 1, height=4.6 if narrow else 4.9, narrow=narrow, sharex=True, height_ratios=(2.2, 1)
    )
    said = []
    for name, title, rows in laws.each(episodes):
        look, table = style.look(name), by_angle(rows)
        upper.fill_between(table["angle"], table["low"], table["high"], color=look.colour, alpha=0.2, linewidth=0)
        upper.plot(
            table["angle"], table["median"], color=look.colour, linestyle=look.line, marker=look.marker, label=title
        )
        first, last = table.iloc[0], table.iloc[-1]
        said.append(
            f"{title} from {first['median']:.2f} s at {first['angle']:.0f} "
            f"to {last['median']:.2f} s at {last['angle']:.0f}"
        )
    kp, kv, tolerance, tick = (float(episodes[name].iloc[0]) for name in ("kp", "kv", "tolerance", "dt_s"))
    angles = np.arange(1.0, 180.0, 1.0)
    curve = closed_form.settling_curve(kp, kv, tolerance)(np.radians(180.0 - angles))
    upper.plot(angles, curve, color=style.INK, linewidth=0.9, label="closed form")
    upper.axhline(
        closed_form.linear_settling(kp, kv, tolerance),
        color=style.MUTED,
        linewidth=0.9,
        linestyle=style.DASHED,
        label="linear system",
    )
    upper.set(ylabel="settling time [s]", ylim=(0.5, TOP_S), xlim=(0, 180))
    upper.legend(loc="upper left")
    late = _residual(lower, episodes[episodes["contender"] == "rotation-matrix"], kp, kv, tolerance, tick)
    lower.set(xlabel="initial angle to the goal [deg]", ylabel="late by [ms]", xticks=range(0, 181, 30))
    lower.set_title("Rotation matrix: measured minus closed form", fontsize=9.5)
    return figure, f"Median settling time by angle in degrees: {', '.join(said)}.{late}"


def by_angle(rows: pd.DataFrame, width_deg: float = BIN_DEG) -> pd.DataFrame:
    """Per bin of the initial angle: middle [deg], starts, share that settles, quantiles of settling time [s]."""
    bins = (np.degrees(rows["angle0_rad"]) // width_deg).clip(upper=180 // width_deg - 1)
    grouped = rows["settling_time_s"].groupby(bins.to_numpy())
    table = pd.DataFrame(
        {
            "angle": (grouped.size().index + 0.5) * width_deg,
            "starts": grouped.size(),
            "settled": grouped.count() / grouped.size(),
            "low": grouped.quantile(LOW),
            "median": grouped.quantile(MIDDLE),
            "high": grouped.quantile(HIGH),
        }
    )
    return table[table["starts"] >= FEWEST].reset_index(drop=True)


def late_ms(rows: pd.DataFrame, kp: float, kv: float, tolerance: float) -> pd.Series:
    """Measured settling time minus its closed form [ms], for rows of the rotation-matrix law at rest."""
    theory = closed_form.settling_curve(kp, kv, tolerance)(np.pi - rows["angle0_rad"].to_numpy())
    return 1000.0 * (rows["settling_time_s"] - theory)


def _residual(axes, rows: pd.DataFrame, kp: float, kv: float, tolerance: float, tick: float) -> str:
    rows = rows[rows["settling_time_s"].notna()].head(DRAWN)
    if rows.empty:
        return ""
    late = late_ms(rows, kp, kv, tolerance)
    look = style.look("rotation-matrix")
    dots(axes, np.degrees(rows["angle0_rad"]), late, look.colour, 2.4, alpha=0.5)
    axes.axhspan(0.0, 1000.0 * tick, facecolor=style.GRID, alpha=0.6, zorder=0)
    axes.text(3, 500.0 * tick, "one tick", va="center", fontsize=9, color=style.MUTED)
    low, high = min(0.0, late.min()), max(1000.0 * tick, late.max())
    axes.set_ylim(low - 0.2 * (high - low), high + 0.2 * (high - low))
    span = f"{late.min():.2f} to {late.max():.2f} ms"
    return f" The rotation-matrix law is {span} later than its closed form ({len(rows)} starts)."
