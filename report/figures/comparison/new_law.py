"""The law that brakes late beside its neighbours, from their scalar equations."""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy.integrate import solve_ivp

from bench.findings.theory.isotropic import EQUATIONS, TIGHT
from bench.law.display import Equation
from bench.law.inputs import PAPERS_GAINS
from report.figures.comparison.cells import LEVEL
from report.figures.kit import families, style
from report.figures.kit.inline import responsive_picture

DRAWN = {law: EQUATIONS[law] for law in ("rotation-matrix", "quaternion-shortest", "rotation-vector", "late-braking")}
"""The first of the laws with one spring stands for all."""

FROM_DEG, SHOWN_S = 175.0, 1.2
"""Angle at which the responses begin, five degrees from where the sine has no pull, and how long they are shown."""


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

    def acceleration(angle, rate):
        return -kp * equation.spring(angle) - kv * rate + equation.added(angle, rate, kp, kv)

    def rate(_, state):
        pull = acceleration(state[0], state[1])
        return state[1], pull, pull * pull

    times = np.linspace(0.0, SHOWN_S, 241)
    angle, speed, effort = solve_ivp(rate, (0.0, SHOWN_S), (theta, 0.0, 0.0), t_eval=times, **TIGHT).y
    return np.array([times, angle, [-acceleration(*each) for each in zip(angle, speed, strict=True)], effort])


@responsive_picture
def responses(narrow: bool):
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
