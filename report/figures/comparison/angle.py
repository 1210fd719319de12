"""Settling time against the initial angle of the laws that turn about one fixed axis: measured, and the closed form."""

import math

import numpy as np
import pandas as pd

from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, NEAREST_RAD, Equation, settling
from report.figures.comparison.comparison import uniform
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run

CURVE = 60
DRAWN = 150
FOOT_S, TOP_S = 0.3, 3.0
"""Limits of the panel, on a logarithmic axis: curves that go to infinity at 180° leave it."""

APART = 0.056
"""Least distance of two labels beside curves, in decades."""

ASIDE_DEG = 7.0
"""How far before a curve leaves the panel its name ends."""


def groups(rows: pd.DataFrame) -> dict[Equation, list[str]]:
    """Equation -> the laws of the run that obey it, family by family."""
    found: dict[Equation, list[str]] = {}
    for name in families.in_order(rows["contender"].unique()):
        if name in EQUATIONS:
            found.setdefault(EQUATIONS[name], []).append(name)
    return found


@responsive_picture
def curves(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Curves of the equations, and dots of the starts, of the first law of each; rows: of `comparison.common`."""
    figure, axes = style.panels(height=4.4 if narrow else 4.2, narrow=narrow)
    kp, kv, tolerance = (float(rows[column].iloc[0]) for column in ("kp", "kv", "tolerance"))
    angles = np.linspace(LEAST_RAD, math.pi - NEAREST_RAD, CURVE)
    beside, words = [], []
    for equation, names in groups(rows).items():
        colours = (style.look(name).colour for name in names)
        colour = next((one for one in colours if one != style.REST), style.REST)
        alpha = 0.5 if colour == style.REST else 1.0
        times = np.array([settling(equation, float(angle), kp, kv, tolerance) for angle in angles])
        axes.plot(
            np.degrees(angles), times, color=colour, linewidth=1.1, alpha=alpha, zorder=2 + (colour != style.REST)
        )
        own = rows[rows["contender"] == names[0]].head(DRAWN)
        style.dots(axes, np.degrees(own["angle0_rad"]), own["settling_time_s"], colour, 3.0, zorder=3, alpha=alpha)
        word = families.word(names[0]) + (f" +{len(names) - 1}" if len(names) > 1 else "")
        words.append(f"{', '.join(map(families.word, names))} from {times[0]:.2f} to {times[-1]:.2f} s")
        leaves = left_at(np.degrees(angles), times)
        if leaves:
            axes.text(*leaves, word, color=colour, fontsize=9, ha="right", va="top" if leaves[1] == TOP_S else "bottom")
        else:
            beside.append((float(times[-1]), word, colour))
    places = 10.0 ** np.array(style.apart([math.log10(time) for time, _, _ in beside], APART))
    for place, (_, word, colour) in zip(places, beside, strict=True):
        style.label_line(axes, 181.5, place, word, colour, fontsize=9)
    axes.set(xlim=(0, 180), yscale="log", ylim=(FOOT_S, TOP_S), xticks=range(0, 181, 30))
    axes.set_yticks([0.3, 0.5, 1.0, 2.0, 3.0], ["0.3", "0.5", "1", "2", "3"])
    axes.minorticks_off()
    axes.set(xlabel="initial angle to the goal [deg]", ylabel="settling time [s]")
    return figure, f"Settling time from {np.degrees(angles[0]):.0f} to nearly 180 degrees: {'; '.join(words)}."


def left_at(angles: np.ndarray, times: np.ndarray) -> tuple[float, float] | None:
    """Return (angle, edge) where the name of a curve that leaves the panel ends; None if the curve stays."""
    outside = np.flatnonzero((times > TOP_S) | (times < FOOT_S))
    if not len(outside) or outside[0] == 0:
        return None
    return float(angles[outside[0]]) - ASIDE_DEG, TOP_S if times[outside[0]] > TOP_S else FOOT_S


def facts(run: Run) -> dict:
    """Draw settling times over the angle."""
    return {"comparison-angle": curves(uniform(run))}
