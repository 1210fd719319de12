"""Settling time against the initial angle of the laws that turn about one fixed axis: measured, and the closed form."""

import math
from typing import Any

import numpy as np
import pandas as pd

from bench.experiments.tables.run import Run
from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, NEAREST_RAD, Equation, settling
from report.figures.comparison.comparison import uniform
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import in_run

SHOWN = ("rotation-matrix", "quaternion-shortest", "rotation-vector", "late-braking", "mrp-memory")
"""The laws with a curve: a law for each error of the chapter's table, the advised one, and ours."""

CURVE = 60
DRAWN = 150
"""Points of a curve, and simulated starts drawn beside it."""

FOOT_S, TOP_S = 0.4, 1.0
"""Limits of the panel: the curves at 180° lie between 0.5 and 0.7 s, and one leaves it upwards."""

GAP_S = 0.03
"""Least distance of two labels beside curves: the height of a line of words in the panel."""

END_DEG, LABEL_DEG = 181.0, 188.0
"""Place where the line from a curve's end to its label begins, and where the label does."""

LATE_DEG = 170
"""The angle at which the caption compares laws."""


def groups(rows: pd.DataFrame) -> dict[Equation, list[str]]:
    """Equation -> the laws of the run that obey it, family by family."""
    found: dict[Equation, list[str]] = {}
    for name in families.in_order(rows["contender"].unique()):
        if name in EQUATIONS:
            found.setdefault(EQUATIONS[name], []).append(name)
    return found


def settle(rows: pd.DataFrame, equation: Equation, angles: np.ndarray) -> np.ndarray:
    """Return the settling time [s] from each angle [rad] with the gains of the rows."""
    kp, kv, tolerance = (float(rows[column].iloc[0]) for column in ("kp", "kv", "tolerance"))
    return np.array([settling(equation, float(angle), kp, kv, tolerance) for angle in angles])


def list_others(rows: pd.DataFrame) -> dict[Equation, list[str]]:
    """Return the equations of the band: no law of them is drawn, none unwinds and none commands without bound."""
    others = {}
    for equation, laws in groups(rows).items():
        compared = [law for law in laws if law not in families.CONTROLS]
        if equation.is_bounded and compared and not set(compared) & set(SHOWN):
            others[equation] = compared
    return others


@responsive_picture
def curves(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw a curve and its simulated starts for each law of SHOWN, and the others as a band; rows: of `common`."""
    figure, axes = style.panels(height=4.6, narrow=narrow)
    angles = np.linspace(LEAST_RAD, math.pi - NEAREST_RAD, CURVE)
    words = [draw_band(axes, rows, angles)]
    ends: dict[str, float] = {}
    for law in SHOWN:
        simulated = rows[rows["contender"] == law]
        if simulated.empty:
            continue
        times, colour = settle(rows, EQUATIONS[law], angles), style.look(law).colour
        axes.plot(np.degrees(angles), times, color=colour, linewidth=1.6, zorder=4)
        drawn = simulated.head(DRAWN)
        style.dots(axes, np.degrees(drawn["angle0_rad"]), drawn["settling_time_s"], colour, 3.0, zorder=3, alpha=0.6)
        words.append(f"{families.word(law)} from {times[0]:.2f} to {times[-1]:.2f} s")
        if times[-1] < TOP_S:
            ends[law] = float(times[-1])
        else:
            leaving_deg = float(np.degrees(angles[np.argmax(times > TOP_S)]))
            aside_deg = 10.0 if narrow else 4.0
            axes.text(
                leaving_deg - aside_deg, TOP_S, families.word(law), color=colour, fontsize=10, ha="right", va="top"
            )
    label_ends(axes, ends)
    axes.set(xlim=(0, 180), ylim=(FOOT_S, TOP_S), xticks=range(0, 181, 60 if narrow else 30))
    axes.set(xlabel="initial angle to the goal [deg]", ylabel="settling time [s]")
    return figure, f"Settling time from {np.degrees(angles[0]):.0f} to nearly 180 degrees: {'; '.join(words)}."


def draw_band(axes: Any, rows: pd.DataFrame, angles: np.ndarray) -> str:
    """Draw the span of the other laws' times; return what it spans, in words."""
    others = list_others(rows)
    if not others:
        return "no other law"
    times = np.array([settle(rows, equation, angles) for equation in others])
    axes.fill_between(np.degrees(angles), times.min(axis=0), times.max(axis=0), color=style.GRID, linewidth=0, zorder=1)
    axes.text(5, FOOT_S + 0.012, "grey: the other laws", color=style.MUTED, fontsize=10, ha="left", va="bottom")
    laws = [law for alike in others.values() for law in alike]
    return f"a band of {len(laws)} other laws, {times[:, -1].min():.2f} to {times[:, -1].max():.2f} s near 180 degrees"


def label_ends(axes: Any, ends: dict[str, float]) -> None:
    """Name each curve beside its end, with a line from the end to a name that had to move."""
    places = style.apart([*ends.values()], GAP_S)
    for (law, end), place in zip(ends.items(), places, strict=True):
        colour = style.look(law).colour
        axes.plot([END_DEG, LABEL_DEG - 1.0], [end, place], color=colour, linewidth=0.9, clip_on=False)
        style.label_line(axes, LABEL_DEG, place, families.word(law), colour, fontsize=10)


def compare_late(rows: pd.DataFrame) -> str:
    """Say how long the laws of SHOWN take from LATE_DEG, the slowest first."""
    angle = np.array([math.radians(LATE_DEG)])
    run = set(rows["contender"])
    times = {law: float(settle(rows, EQUATIONS[law], angle)[0]) for law in SHOWN if law in run}
    slowest, fastest = max(times, key=times.__getitem__), min(times, key=times.__getitem__)
    return (
        f"From a start {LATE_DEG}° away from the goal, the body settles in {times[slowest]:.2f} s with "
        f"{families.word(slowest)} and in {times[fastest]:.2f} s with {families.word(fastest)}"
    )


def facts(run: Run) -> dict:
    """Draw settling times over the angle, and say what the picture shows and how many laws are in its band."""
    rows = uniform(run)
    others = list_others(rows)
    unbounded = [law for equation, laws in groups(rows).items() if not equation.is_bounded for law in laws]
    return {
        "comparison-angle": curves(rows),
        "finding": in_run(compare_late, rows),
        "band": sum(map(len, others.values())),
        "unbounded": " and ".join(map(families.word, unbounded)) or "none",
    }
