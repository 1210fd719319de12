"""The page on the law that brakes late: its response beside its neighbours'."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from bench.experiments.tables import read
from bench.findings.theory.closed_form import linear_settling
from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, TIGHT, settling
from bench.law.display import Equation
from bench.law.inputs import PAPERS_GAINS
from report.figures.comparison import cells, comparison
from report.figures.comparison.cells import LEVEL
from report.figures.cost.operations import CALLS
from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run, in_run
from tasks.rules import RULES

NEW = "late-braking"
RATIOS = 0.5, 0.7, 1.0, 1.5
"""Damping ratios at which it is compared with a linear system."""

LATE = EQUATIONS[NEW]

DRAWN = {law: EQUATIONS[law] for law in ("rotation-matrix", "quaternion-shortest", "rotation-vector", "late-braking")}
"""The first of the laws with one spring stands for all."""

FROM_DEG, SHOWN_S = 175.0, 1.2
"""Angle at which the responses begin, five degrees from where the sine has no pull, and how long they are shown."""


def facts(run: Run) -> dict:
    """Return by the equations how slow and strong this law is against the straight spring; and operations a tick."""
    counted = run.any_rows("costs", **read.FREE_BODY)
    spent = counted[counted["stage"] == "total"].set_index(["contender", "branch"])
    return {
        "at_peak": in_run(lambda: compare_at_equal_peak(comparison.at_peak(run))),
        "slowest": f"{longest(LATE, *PAPERS_GAINS):.3f}",
        "linear": f"{linear_settling(*PAPERS_GAINS):.3f}",
        "later": ", ".join(f"{ratio:g}" for ratio in RATIOS if is_later(ratio)) or "none",
        "later_of": f"{', '.join(map('{:g}'.format, RATIOS))}",
        **(count_calls(spent.loc[NEW, "typical"]) if (NEW, "typical") in spent.index else {}),
        "pull": f"{greatest_pull(LATE):.2f}",
    }


def compare_at_equal_peak(rows: pd.DataFrame) -> str:
    """Count the published laws that are as fast as this one, or spend as little, with gains for one peak command."""
    times, efforts = cells.costs(rows, "settling_time_s"), cells.costs(rows, "effort")
    others = [law for law in times if law != NEW and law not in families.CONTROLS]
    measures = {
        "median settling time": cells.medians(times),
        "slowest start": times.max(),
        "median effort": cells.medians(efforts),
    }
    units = ("s", "s", "rad²/s³")
    parts = [
        f"{name} {own[NEW]:.3g} {unit} ({(own[others] <= own[NEW]).sum()} of {len(others)} published laws need no more)"
        for (name, own), unit in zip(measures.items(), units, strict=True)
    ]
    return f"With gains that give every law a peak command of {LEVEL:g} rad/s² from rest: {'; '.join(parts)}."


def is_later(ratio: float) -> bool:
    """Tell whether this law's slowest start settles a millisecond later than a linear system of this damping ratio."""
    kp = PAPERS_GAINS[0]
    kv = 2.0 * ratio * math.sqrt(kp)
    return longest(LATE, kp, kv) > linear_settling(kp, kv) + 1e-3


def count_calls(row: pd.Series) -> dict[str, int]:
    """Return the flops, the square roots and the trigonometric calls of a row of costs.parquet."""
    return {"flops": int(row["flops"]), "roots": int(row["sqrt"]), "calls": int(row[list(CALLS)].sum())}


def longest(equation: Equation, kp: float, kv: float) -> float:
    """Return the longest settling time [s] from rest, over angles up to 180°."""
    return max(settling(equation, angle, kp, kv, RULES.tolerance) for angle in np.linspace(LEAST_RAD, math.pi, 24))


def peak_gains(equation: Equation) -> tuple[float, float]:
    """(kp, kv) with which the greatest pull over all angles is LEVEL, critically damped near the goal."""
    kp = LEVEL / greatest_pull(equation)
    return kp, 2.0 * math.sqrt(kp)


def greatest_pull(equation: Equation) -> float:
    """max f: the greatest command from rest, over Kp."""
    return max(map(equation.spring, np.linspace(0.0, math.pi, 1801)))


@functools.cache
def response(equation: Equation, theta: float, kp: float, kv: float) -> np.ndarray:
    """Rows: time [s], angle [rad], command towards the goal [rad/s^2], integral of its square; from rest at theta."""

    def acceleration(angle: float, rate: float) -> float:
        return -kp * equation.spring(angle) - kv * rate + equation.added(angle, rate, kp, kv)

    def rate(_: float, state: np.ndarray) -> tuple[float, float, float]:
        pull = acceleration(state[0], state[1])
        return state[1], pull, pull * pull

    times = np.linspace(0.0, SHOWN_S, 241)
    angle, speed, effort = solve_ivp(rate, (0.0, SHOWN_S), (theta, 0.0, 0.0), t_eval=times, **TIGHT).y
    return np.array([times, angle, [-acceleration(*each) for each in zip(angle, speed, strict=True)], effort])


@responsive_picture
def responses(narrow: bool) -> tuple[Figure, str]:
    """Draw angle and command against time from nearly 180°: at equal gain, and at equal peak command."""
    figure, axes = style.panels(
        *((4, 1) if narrow else (2, 2)), height=9.6 if narrow else 5.2, narrow=narrow, sharex=True
    )
    above, below = (axes[::2], axes[1::2]) if narrow else axes
    words = []
    for i, (title, gains) in enumerate((("Equal gain", lambda _: PAPERS_GAINS), ("Equal peak", peak_gains))):
        ends = []
        for name, equation in DRAWN.items():
            look = style.look(name)
            times, angle, command, _ = response(equation, math.radians(FROM_DEG), *gains(equation))
            marks = {"color": look.colour, "linestyle": look.line}
            above[i].plot(times, np.degrees(angle), label=families.word(name), **marks)
            below[i].plot(times, command, **marks)
            half = times.searchsorted(SHOWN_S / 2.0)
            ends.append(f"{families.word(name)} {np.degrees(angle[half]):.1f} degrees")
        above[i].set(title=title, ylim=(0, 180), yticks=range(0, 181, 60))
        below[i].axhline(0.0, color=style.MUTED, linewidth=0.7)
        words.append(f"{title.lower()}: {', '.join(ends)}")
    for each in above if narrow else above[:1]:
        each.set_ylabel("angle to the goal [deg]")
    for each in below if narrow else below[:1]:
        each.set_ylabel("command [rad/s²]")
    for each in below[-1:] if narrow else below:
        each.set(xlabel="time [s]", xlim=(0, SHOWN_S))
    figure.legend(*above[0].get_legend_handles_labels(), loc="outside upper left", ncols=2 if narrow else 4)
    return figure, f"Left after {SHOWN_S / 2.0:g} s of {FROM_DEG:g} degrees. At {'; at '.join(words)}."


def figures(_: Run) -> dict[str, Any]:
    """Return how it responds."""
    return {"new-law-responses": responses()}
