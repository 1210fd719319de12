"""Settling time against angle: the three laws' bands, and the closed form of the rotation-matrix law."""

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.kit import laws, style
from report.figures.kit.inline import responsive_picture

BIN_DEG = 10
FEWEST = 5
"""A bin of fewer starts says nothing about its quantiles."""

LOW, MIDDLE, HIGH = 0.05, 0.5, 0.95
TOP_S = 1.8


@responsive_picture
def bands(episodes: pd.DataFrame, narrow: bool):
    """Median and 5 to 95 % of settling time by angle.

    Args:
        episodes: rows of one engine and of the set uniform; what does not settle has no time and is left out.
    """
    figure, axes = style.panels(height=3.4, narrow=narrow)
    said = []
    for name, title, rows in laws.each(episodes):
        look, table = style.look(name), by_angle(rows)
        axes.fill_between(table["angle"], table["low"], table["high"], color=look.colour, alpha=0.2, linewidth=0)
        marks = {"color": look.colour, "linestyle": look.line, "marker": look.marker}
        axes.plot(table["angle"], table["median"], label=title, **marks)
        first, last = table.iloc[0], table.iloc[-1]
        said.append(
            f"{title} from {first['median']:.2f} s at {first['angle']:.0f} "
            f"to {last['median']:.2f} s at {last['angle']:.0f}"
        )
    kp, kv, tolerance = (float(episodes[name].iloc[0]) for name in ("kp", "kv", "tolerance"))
    angles = np.arange(1.0, 180.0, 1.0)
    curve = closed_form.settling_curve(kp, kv, tolerance)(np.radians(180.0 - angles))
    axes.plot(angles, curve, color=style.INK, linewidth=0.9, label="closed form")
    linear = closed_form.linear_settling(kp, kv, tolerance)
    axes.axhline(linear, color=style.MUTED, linewidth=0.9, linestyle=style.DASHED, label="linear system")
    axes.set(xlabel="initial angle to the goal [deg]", ylabel="settling time [s]")
    axes.set(ylim=(0.5, TOP_S), xlim=(0, 180), xticks=range(0, 181, 30))
    axes.legend(loc="upper left")
    return figure, f"Median settling time by angle in degrees: {', '.join(said)}."


def by_angle(rows: pd.DataFrame) -> pd.DataFrame:
    """Per bin of the initial angle: middle [deg], quantiles of settling time [s]."""
    bins = (np.degrees(rows["angle0_rad"]) // BIN_DEG).clip(upper=180 // BIN_DEG - 1)
    grouped = rows["settling_time_s"].groupby(bins.to_numpy())
    table = pd.DataFrame(
        {
            "angle": (grouped.size().index + 0.5) * BIN_DEG,
            "low": grouped.quantile(LOW),
            "median": grouped.quantile(MIDDLE),
            "high": grouped.quantile(HIGH),
        }
    )
    return table[(grouped.size() >= FEWEST).to_numpy()].reset_index(drop=True)


def late_ms(rows: pd.DataFrame, kp: float, kv: float, tolerance: float) -> pd.Series:
    """Measured settling time minus its closed form [ms], for rows of the rotation-matrix law at rest."""
    theory = closed_form.settling_curve(kp, kv, tolerance)(np.pi - rows["angle0_rad"].to_numpy())
    return 1000.0 * (rows["settling_time_s"] - theory)
