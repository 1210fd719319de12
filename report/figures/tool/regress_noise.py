"""Comparisons of the same code: the ratio of every benchmark in every one, which should be 1."""

from __future__ import annotations

import pandas as pd

from bench.regression.revisions.rule import RATIO, P
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.tool.regress_rows import not_run

QUIET, DOUBTED, ALARM = "#56b4e9", "#e69f00", "#d55e00"


@responsive_picture
def ratios(rows: pd.DataFrame, *, narrow=False):
    """Head over base of the first run, a column a comparison; what a second run took back, and what it did not.

    Args:
        rows: regress_rows.verdicts().
    """
    if rows.empty:
        return not_run(narrow)
    figure, axes = style.panels(height=3.4, narrow=narrow)
    kinds = {
        "same": (rows[~rows["doubted"]], QUIET, ".", 4),
        "doubted, and taken back by the second run": (rows[rows["doubted"] & ~rows["alarm"]], DOUBTED, "s", 5),
        "false alarm": (rows[rows["alarm"]], ALARM, "X", 7),
    }
    for name, (chosen, colour, marker, size) in kinds.items():
        if len(chosen) or name == "same":
            marks = {"color": colour, "marker": marker, "markersize": size, "linestyle": "none", "alpha": 0.75}
            axes.plot(chosen["comparison"], chosen["ratio"], label=name, **marks)
    for bound in (RATIO, 1.0 / RATIO):
        axes.axhline(bound, color=style.MUTED, linewidth=1.0, linestyle=style.DASHED)
    axes.set_yscale("log")
    ticks = [tick for tick in (0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.4, 1.6) if _shown(tick, rows)]
    axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set(xlabel="Comparison", ylabel="Time, head over base")
    figure.legend(loc="outside upper left", ncols=1 if narrow else 3)
    alt = (
        f"{rows['comparison'].nunique()} comparisons of the same code, {rows['benchmark'].nunique()} benchmarks each: "
        f"ratios from {rows['ratio'].min():.3f} to {rows['ratio'].max():.3f}; {int(rows['doubted'].sum())} "
        f"with p < {P} and a ratio beyond {RATIO} in the first run, {int(rows['alarm'].sum())} in the second too."
    )
    return figure, alt


def _shown(tick: float, rows: pd.DataFrame) -> bool:
    """Whether a tick is within what is drawn."""
    return min(rows["ratio"].min(), 0.88) <= tick <= max(rows["ratio"].max(), 1.12)
