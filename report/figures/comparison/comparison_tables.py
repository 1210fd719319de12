"""The comparison as tables, a row a law: whether and how fast it settles; its way, its effort, what a tick costs."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.tables.statistics import Estimate, quantile_estimate
from report.figures.comparison.comparison_rows import DETOUR, axis_words, costs
from report.figures.cost.operations import CALLS
from report.figures.kit import families, html
from report.figures.kit.share import share
from report.figures.kit.spelling import power

NEVER = "never"
SMALL_PEAK = 1e4
"""Commands [rad/s^2] above this are those of a division by nearly nothing."""


def settling(rows: pd.DataFrame) -> html.Markdown:
    """Share that settles, median and 99th percentile of settling time with intervals, and the worst start.

    Args:
        rows: of `comparison_rows.common`.
    """
    times = costs(rows, "settling_time_s")

    def line(name: str, own: pd.DataFrame) -> dict:
        found = share(int((own["outcome"] == "settled").sum()), len(own))
        cells = {"Settles [%]": with_interval(*map(percent, (found.value, found.low, found.high)))}
        for label, level in (("Median [s]", 0.5), ("99 % [s]", 0.99)):
            cells[label] = seconds(quantile_estimate(times[name].to_numpy(), level))
        return cells | {"Worst start": worst(own)}

    return by_family(rows, line)


def way(rows: pd.DataFrame, counted: pd.DataFrame) -> html.Markdown:
    """Overshoot, detours, effort and peak of the command, and operations a tick.

    Args:
        rows: of `comparison_rows.common`. counted: rows of costs.parquet about the free body.
    """
    efforts = costs(rows, "effort")
    totals = counted[(counted["branch"] == "typical") & (counted["stage"] == "total")].set_index("contender")

    def line(name: str, own: pd.DataFrame) -> dict:
        effort, total = quantile_estimate(efforts[name].to_numpy(), 0.5), totals.loc[name]
        calls = int(total[list(CALLS)].sum())
        return {
            "Overshoot [deg]": f"{np.degrees(own['overshoot_rad'].max()):.0f}",
            "Detours [%]": percent(float((own["path_ratio"] > DETOUR).mean())),
            "Effort": figures(effort),
            "Peak": large(own["peak_u"].max()),
            "A tick": f"{int(total['flops'])} + {calls}" if calls else f"{int(total['flops'])}",
        }

    return by_family(rows, line)


def by_family(rows: pd.DataFrame, line) -> html.Markdown:
    """A line for each law's rows, under the name of its family."""
    lines: list[dict] = []
    for family in families.present(rows["contender"].unique()):
        lines.append({"Law": f"*{family.title}*"})
        for name, word in family.laws.items():
            lines.append({"Law": families.link(name, word), **line(name, rows[rows["contender"] == name])})
    frame = pd.DataFrame(lines).fillna("")
    return html.table(frame[["Law", *(column for column in frame if column != "Law")]], words=frame.columns)


def percent(part: float) -> str:
    """A share in per cent, to a tenth, whole where it is all or nothing."""
    return f"{100 * part:.0f}" if part in (0.0, 1.0) else f"{100 * part:.1f}"


def seconds(found: Estimate) -> str:
    """A time with its interval; a quantile among the failures is never reached."""
    return spelled(found, lambda value: f"{value:.3f}")


def figures(found: Estimate) -> str:
    """A number of any size with its interval, to three figures."""
    return spelled(found, lambda value: html.number(float(f"{value:.3g}")))


def large(value: float) -> str:
    """A number to three figures, or as a power of ten where it stands for no bound."""
    return html.number(float(f"{value:.3g}")) if value < SMALL_PEAK else power(value)


def spelled(found: Estimate, write) -> str:
    """An estimate as words; where both ends are the number itself, the number alone."""
    value, low, high = (write(one) if np.isfinite(one) else NEVER for one in found)
    return value if value == low == high else with_interval(value, low, high)


def with_interval(value: str, low: str, high: str) -> str:
    """A number, and its interval, which no line breaks."""
    return f"{value} {html.together(f'({low} to {high})')}"


def worst(own: pd.DataFrame) -> str:
    """The nearest start that fails, or else the slowest, by its angle and axis."""
    failed = own[own["outcome"] != "settled"]
    if len(failed):
        start = failed.loc[failed["angle0_rad"].idxmin()]
        return f"fails from {np.degrees(start['angle0_rad']):.0f}°, {axis_words(start)}"
    start = own.loc[own["settling_time_s"].idxmax()]
    return f"{start['settling_time_s']:.2f} s from {np.degrees(start['angle0_rad']):.0f}°, {axis_words(start)}"
