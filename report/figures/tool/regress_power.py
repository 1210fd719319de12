"""A law made slower by steps: which share of comparisons finds it by time, and how many more instructions it has."""

from __future__ import annotations

import pandas as pd

from bench.regression.revisions.instructions import TOLERANCE
from bench.regression.revisions.rule import RATIO
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.tool.regress_rows import not_run

ONCE, TWICE, COUNTED = "#56b4e9", "#0072b2", "#d55e00"


@responsive_picture
def found(rows: pd.DataFrame, *, narrow=False):
    """Above the shares found by time, below the instructions; against how much slower the law truly is.

    Args:
        rows: regress_rows.power().
    """
    if rows.empty:
        return not_run(narrow)
    figure, (above, below) = style.panels(2, 1, height=4.6, narrow=narrow, sharex=True, height_ratios=(3, 2))
    slower = 100.0 * rows["slower"]
    above.plot(slower, 100.0 * rows["once"], color=ONCE, marker="o", linestyle=style.DASHED, label="one run")
    above.plot(slower, 100.0 * rows["twice"], color=TWICE, marker="s", label="and a second that agrees")
    above.axvline(100.0 * (RATIO - 1.0), color=style.MUTED, linewidth=1.0, linestyle=style.DOTTED)
    above.set(ylabel="Found by time [%]", ylim=(-5, 105))
    below.plot(slower, 100.0 * rows["instructions"], color=COUNTED, marker="^", linestyle=style.DASH_DOT)
    below.axhline(100.0 * TOLERANCE, color=style.MUTED, linewidth=1.0, linestyle=style.DOTTED)
    below.set(ylabel="More instr. [%]", xlabel="Slower, measured [%]")
    figure.legend(loc="outside upper left", ncols=1 if narrow else 2)
    alt = "; ".join(
        f"{100 * row.slower:.1f} % slower: found in {100 * row.once:.0f} % of runs, in {100 * row.twice:.0f} % twice, "
        f"{100 * row.instructions:+.1f} % instructions"
        for row in rows.itertuples()
    )
    return figure, f"{alt}."
