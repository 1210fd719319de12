"""The error of other libraries' rotation vectors: over small turns, and over the distance to the half turn."""

from __future__ import annotations

import textwrap

import numpy as np
import pandas as pd

from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.spelling import power
from report.figures.libraries.answers import COUNT_RAD, VECTOR

FLOOR = 1e-17
"""Where an error of exactly zero is drawn."""
EXACT = 3e-17
"""Where the half turn itself is drawn, beyond the nearest turn."""
GOOD_RAD = 1e-12
"""Curves that stay below this towards the half turn, and below a count on small turns, are drawn as one band."""

LEGEND_LETTERS = 46
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#a39400")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "d", "p", "<", "h")
LINES = (style.SOLID, style.DASHED, style.DASH_DOT)


def curves(rows: pd.DataFrame, column: str) -> pd.DataFrame:
    """Largest error by function (rows) and angle or distance (columns), of functions that give the rotation vector."""
    own = rows[(rows["form"] == VECTOR) & rows[column].notna()]
    return own.pivot_table(index=["library", "function"], columns=column, values="error_rad", sort=False)


def equal_curves(*tables: pd.DataFrame) -> dict[str, list[int]]:
    """Curves that are equal to two figures where they are not good are drawn once: label to the rows' numbers."""
    good = [table.clip(lower=GOOD_RAD) for table in tables]
    keys = [tuple(f"{value:.1e}" for table in good for value in table.iloc[i]) for i in range(len(tables[0]))]
    found: dict[tuple, list[int]] = {}
    for i, key in enumerate(keys):
        found.setdefault(key, []).append(i)
    return {named([tables[0].index[i] for i in members]): members for members in found.values()}


def named(members: list[tuple[str, str]]) -> str:
    """`library: function, function; library: ...`, without what stands in the legend's way."""
    by_library: dict[str, list[str]] = {}
    for library, function in members:
        by_library.setdefault(library, []).append(function.partition(", of a ")[0])
    return "; ".join(f"{library} {', '.join(dict.fromkeys(names))}" for library, names in by_library.items())


@responsive_picture
def digits(rows: pd.DataFrame, *, narrow=False):
    """Left: error over the angle of small turns; right: over the distance to the half turn, itself at the end."""
    small, near = curves(rows, "angle_rad"), curves(rows, "distance_rad")
    off = (small.max(axis=1) > COUNT_RAD) | (near.max(axis=1) > GOOD_RAD)
    shown = equal_curves(small[off], near[off])
    shape, height = ((2, 1), 9.6) if narrow else ((1, 2), 5.6)
    figure, (left, right) = style.panels(*shape, height=height, narrow=narrow, sharey=True)
    looks = {label: _look(i) for i, label in enumerate(shown)}
    for axes, table in ((left, small), (right, near)):
        apart = table.columns == 0.0
        x = np.where(apart, EXACT, table.columns)
        quiet = table.loc[~off, ~apart].clip(lower=FLOOR)
        label = f"the other {int((~off).sum())}" if axes is left else None
        axes.fill_between(x[~apart], FLOOR, quiet.max(axis=0), color=style.MUTED, alpha=0.25, linewidth=0, label=label)
        for name, members in shown.items():
            look = looks[name]
            y = table[off].iloc[members[0]].clip(lower=FLOOR)
            drawn = {"color": look.colour, "linestyle": look.line, "marker": look.marker, "markersize": 3.5}
            wrapped = "\n".join(textwrap.wrap(name, LEGEND_LETTERS))
            axes.plot(x[~apart], y[~apart], linewidth=1.2, label=wrapped if axes is left else None, **drawn)
            axes.plot(x[apart], y[apart], **{**drawn, "linestyle": "none", "markersize": 5.0})
        axes.axhline(COUNT_RAD, color=style.INK, linewidth=0.8, linestyle=style.DOTTED)
        axes.set(xscale="log", yscale="log", ylim=(FLOOR, 30.0))
        axes.minorticks_off()
    left.set(xlabel="Angle of the turn [rad]", ylabel="Largest error [rad]")
    right.set_xlabel("Distance to the half turn [rad]")
    right.invert_xaxis()
    right.set_xticks([1e-1, 1e-5, 1e-9, 1e-13, EXACT], ["$10^{-1}$", "$10^{-5}$", "$10^{-9}$", "$10^{-13}$", "0"])
    left.set_title("Small turns", fontweight="normal")
    right.set_title("Towards the half turn", fontweight="normal")
    style.label_line(right, 3e-9, COUNT_RAD * 6.0, "one count of 24 bits", fontsize=8.5)
    style.label_line(right, 1e-8, 0.3, "the long way round", fontsize=8.5)
    if narrow:
        right.set_ylabel("Largest error [rad]")
    figure.legend(loc="outside upper left", ncols=1 if narrow else 2, columnspacing=1.2, fontsize=8.5)
    words = "; ".join(
        f"{name} up to {power(table_max(small, off, members))} rad on small turns and "
        f"{power(table_max(near, off, members))} rad near or at half turns"
        for name, members in shown.items()
    )
    return figure, (
        f"Largest error of rotation vectors, logarithmic. {int((~off).sum())} functions stay below "
        f"{power(max(near[~off].to_numpy().max(), small[~off].to_numpy().max()))} rad. {words}."
    )


def table_max(table: pd.DataFrame, off: pd.Series, members: list[int]) -> float:
    """Largest error of a family."""
    return float(table[off].iloc[members[0]].max())


def _look(i: int) -> style.Look:
    return style.Look(COLOURS[i % len(COLOURS)], MARKERS[i % len(MARKERS)], LINES[(i // len(COLOURS)) % len(LINES)])
