"""The comparison at equal peak command: each law with the gains that its motor allows, not with the same stiffness."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.tables.statistics import quantile, quantile_estimate
from report.figures.comparison.comparison_rows import costs, in_families
from report.figures.comparison.comparison_tables import by_family, figures, percent, seconds, with_interval
from report.figures.kit import absent, families, html
from report.figures.kit.share import share

MATRIX = "rotation-matrix"
LEVEL = 100.0
"""Greatest command from rest [rad/s^2]: what the 1980 law asks for at the paper's gains. Time goes as 1/sqrt(LEVEL)."""


def rows() -> pd.DataFrame:
    """Rows of every law at LEVEL, family by family; a law whose command has no bound has none."""
    every = absent.robustness(axis="equal-peak")
    return in_families(every[every["level"] == LEVEL]) if len(every) else every


def table(found: pd.DataFrame) -> html.Markdown:
    """The gain that the peak allows; share that settles; median and slowest settling time; effort."""
    return absent.table(found, _table)


def _table(found: pd.DataFrame) -> html.Markdown:
    times, efforts = costs(found, "settling_time_s"), costs(found, "effort")

    def line(name: str, own: pd.DataFrame) -> dict:
        settled = share(int((own["outcome"] == "settled").sum()), len(own))
        slowest = times[name].max()
        return {
            "$K_p$": f"{own['kp'].iloc[0]:.1f}",
            "Settles [%]": with_interval(*map(percent, (settled.value, settled.low, settled.high))),
            "Median [s]": seconds(quantile_estimate(times[name].to_numpy(), 0.5)),
            "Slowest [s]": f"{slowest:.2f}" if np.isfinite(slowest) else "never",
            "Effort": figures(quantile_estimate(efforts[name].to_numpy(), 0.5)),
        }

    return by_family(found, line)


def facts(found: pd.DataFrame) -> dict:
    """The level, the starts, and two sentences: on the fastest laws, and on the rotation matrix."""
    if found.empty:
        return dict.fromkeys(("peak", "peak_starts", "peak_fastest", "peak_matrix"), html.MISSING)
    times = costs(found, "settling_time_s")
    medians = pd.Series({name: float(quantile(times[name].to_numpy(), 0.5)) for name in times})
    slowest = times.max()
    fastest, surest = medians.idxmin(), slowest.idxmin()
    best = f"Now the fastest in the median is {families.word(fastest)}, {medians[fastest]:.2f} s"
    if fastest == surest:
        best += f", and from its slowest start too, {slowest[fastest]:.2f} s."
    else:
        best += (
            f", but its slowest start takes {slowest[fastest]:.2f} s. The slowest start is the fastest with "
            f"{families.word(surest)}, {slowest[surest]:.2f} s."
        )
    matrix = f"{medians[MATRIX]:.2f} s in the median, and {slowest[MATRIX]:.2f} s from its slowest start"
    return {"peak": html.number(LEVEL), "peak_starts": len(times), "peak_fastest": best, "peak_matrix": matrix}
