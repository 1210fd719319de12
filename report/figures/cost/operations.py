"""Operations a tick of every law, by kind: what a count says, with transcendental calls apart."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import wrap

import pandas as pd

from report.figures.kit import laws, style
from report.figures.kit.inline import responsive_picture

# kind -> (columns of costs.parquet, colour)
KINDS = {
    "add": (("add",), "#56b4e9"),
    "multiply": (("mul",), "#0072b2"),
    "divide, root": (("div", "sqrt"), "#cc79a7"),
    "transcendental": (("sin", "cos", "atan2", "acos"), "#d55e00"),
}
CALLS = KINDS["transcendental"][0]
NARROW_LETTERS = 20
LEAST_LABELLED = 2
"""A narrower piece of a bar has no room for its number."""


def by_kind(costs: pd.DataFrame, branch: str = "typical") -> pd.DataFrame:
    """Return a row a contender, the cheapest first, a column a kind; the goal's stage included."""
    rows = costs[(costs["branch"] == branch) & (costs["stage"] == "total")].set_index("contender")
    kinds = pd.DataFrame({kind: rows[list(columns)].sum(axis=1) for kind, (columns, _) in KINDS.items()})
    return kinds.loc[kinds.sum(axis=1).sort_values(kind="stable").index]


@responsive_picture
def operations(costs: pd.DataFrame, *, narrow=False):
    """Bars of operations by kind, one a law."""
    kinds = by_kind(costs)
    figure, axes = style.panels(height=0.75 + (0.6 if narrow else 0.36) * len(kinds), narrow=narrow)
    colours = {kind: colour for kind, (_, colour) in KINDS.items() if kinds[kind].any()}
    stack(axes, kinds, colours, 0.62, LEAST_LABELLED * (2 if narrow else 1))
    names = [laws.title(name) for name in kinds.index]
    axes.set_yticks(range(len(kinds)), ["\n".join(wrap(name, NARROW_LETTERS)) for name in names] if narrow else names)
    axes.invert_yaxis()
    axes.set_xlabel("Operations a tick, typical branch")
    style.listed(axes)
    axes.legend(
        loc="lower center", bbox_to_anchor=(0.35, 1.0), ncols=2 if narrow else 5, columnspacing=1.2, handlelength=1
    )
    words = "; ".join(
        f"{laws.title(name)} {row.sum() - row['transcendental']} + {row['transcendental']}"
        for name, row in kinds.iterrows()
    )
    return figure, f"Operations a tick by kind, one bar a law, flops + transcendental calls: {words}."


def stack(axes, table: pd.DataFrame, colours: Mapping[str, str], height: float, least: float) -> pd.Series:
    """Draw a bar a row of coloured pieces, long ones with their number; return their ends."""
    left = pd.Series(0, index=table.index)
    for kind, colour in colours.items():
        look = {"color": colour, "height": height, "label": kind, "edgecolor": style.PAPER}
        axes.barh(range(len(table)), table[kind], left=left, **look)
        words = {"ha": "center", "va": "center", "fontsize": 8.5, "color": ink(colour)}
        for place, (start, width) in enumerate(zip(left, table[kind], strict=True)):
            if width >= least:
                axes.text(start + width / 2, place, f"{width}", **words)
        left = left + table[kind]
    return left


def ink(colour: str) -> str:
    """Return a colour for numbers on a bar that reads on both pages."""
    if colour == "#b9c3cf":  # the one whose twin is darker than itself
        return style.INK
    return style.PAPER if colour in ("#0072b2", "#d55e00") else style.ON_COLOUR
