"""Operations a tick of every law, by kind: what a count says, with transcendental calls apart."""

from textwrap import fill

import pandas as pd

from report.figures.kit import laws, style
from report.figures.kit.inline import Drawing, responsive_picture

# kind -> (columns of costs.parquet, colour, colour of the numbers on it)
KINDS = {
    "add": (("add",), "#56b4e9", style.ON_COLOUR),
    "multiply": (("mul",), "#0072b2", style.PAPER),
    "divide, root": (("div", "sqrt"), "#cc79a7", style.ON_COLOUR),
    "transcendental": (("sin", "cos", "atan2", "acos"), "#d55e00", style.PAPER),
}
CALLS = KINDS["transcendental"][0]
NARROW_LETTERS = 20
LEAST_LABELLED = 2
"""A narrower piece of a bar has no room for its number."""


@responsive_picture
def operations(costs: pd.DataFrame, *, narrow: bool = False) -> Drawing:
    """Draw a bar a law, the cheapest first, in pieces by kind; the goal's stage included."""
    rows = costs[(costs["branch"] == "typical") & (costs["stage"] == "total")].set_index("contender")
    kinds = pd.DataFrame({kind: rows[list(columns)].sum(axis=1) for kind, (columns, *_) in KINDS.items()})
    kinds = kinds.loc[kinds.sum(axis=1).sort_values(kind="stable").index]
    figure, axes = style.panels(height=0.75 + (0.6 if narrow else 0.36) * len(kinds), narrow=narrow)
    least = LEAST_LABELLED * (2 if narrow else 1)
    for kind, (_, colour, ink) in KINDS.items():
        left = kinds.loc[:, :kind].sum(axis=1) - kinds[kind]
        bars = axes.barh(range(len(kinds)), kinds[kind], 0.62, left, color=colour, label=kind, edgecolor=style.PAPER)
        words = [f"{width}" if width >= least else "" for width in kinds[kind]]
        axes.bar_label(bars, words, label_type="center", fontsize=8.5, color=ink)
    names = [laws.title(name) for name in kinds.index]
    axes.set_yticks(range(len(kinds)), [fill(name, NARROW_LETTERS) for name in names] if narrow else names)
    axes.invert_yaxis()
    axes.set_xlabel("Operations a tick, typical branch")
    style.listed(axes)
    axes.legend(
        loc="lower center", bbox_to_anchor=(0.35, 1.0), ncols=2 if narrow else 4, columnspacing=1.2, handlelength=1
    )
    flops = kinds.drop(columns="transcendental").sum(axis=1)
    said = "; ".join(
        f"{name} {spent} + {calls}" for name, spent, calls in zip(names, flops, kinds["transcendental"], strict=True)
    )
    return figure, f"Operations a tick by kind, one bar a law, flops + transcendental calls: {said}."
