"""What is measured of a law: criteria as data, each with what it means and how it is computed from a run's tables."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.findings.claims.standing import MEASURABLE
from bench.findings.selection.measures import (
    held_by_noise_from,
    jump,
    later_than_fastest,
    longest_path,
    of_one_law,
    on_arms,
    over_uniform,
    perturbed,
)
from bench.findings.selection.tables import Tables, by_law

LEAST, GREATEST = 1.0, -1.0
"""Which is better."""

NOTABLE = 0.01
"""Differences below a hundredth are no reason to choose a law."""


class Criterion(NamedTuple):
    """One number of a law, from one value a start (or from one value alone).

    measure(tables) -> law: values, all laws' in the order of the same starts; a law that was not asked is missing.
    level: the quantile that is taken of the values, 1 the largest; None: their mean. sense: LEAST or GREATEST is
    better. notable, least: relative and absolute difference up to which two laws tie. form: how the number is written.
    """

    name: str
    title: str
    unit: str
    meaning: str
    measure: Callable[[Tables], dict[str, np.ndarray]]
    level: float | None = 0.5
    sense: float = LEAST
    notable: float = NOTABLE
    least: float = 0.0
    form: str = "{:.3g}"


SLOW_HZ, LATE_S, BOUND, PEAK, HEAVY, SPIN, MOVING, NOISY_RAD = 20.0, 0.02, 10.0, 100.0, 2.0, 20.0, 10.0, 0.01
"""The level of each perturbation at which laws are asked: the hardest, but for peak (the paper's own, at kp = 100)
and for noise, where it is what a cheap sensor has."""


def settled_under(name: str, title: str, words: str, axis: str, level: float) -> Criterion:
    """The median settling time at one level of a perturbation."""
    meaning = f"median settling time{words}"
    return Criterion(name, title, "s", meaning, perturbed(axis, level, "settling_time_s"), form="{:.3f}")


CRITERIA = (
    Criterion(
        "unsettled",
        "Not settled",
        "%",
        "uniform starts that do not settle",
        lambda tables: {name: 100.0 * lost for name, lost in by_law(tables.uniform, "lost").items()},
        None,
    ),
    Criterion(
        "lost",
        "Directed starts",
        "lost",
        "directed starts that do not settle, exact 180° rotations, poles and jumps of coordinates among them",
        lambda tables: {name: np.array([lost.sum()]) for name, lost in by_law(tables.directed, "lost").items()},
    ),
    Criterion(
        "detour", "Longest path", "", "longest path over the shortest, from uniform and half-turn starts", longest_path
    ),
    Criterion(
        "time",
        "99 % settled in",
        "s",
        "time in which 99 % of the uniform starts settle",
        over_uniform("settling_time_s"),
        0.99,
        form="{:.3f}",
    ),
    Criterion(
        "median",
        "Median settling time",
        "s",
        "median settling time of the uniform starts",
        over_uniform("settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "worst",
        "Slowest start",
        "s",
        "settling time of the slowest uniform start",
        over_uniform("settling_time_s"),
        1.0,
        form="{:.3f}",
    ),
    Criterion(
        "spread",
        "Spread of settling",
        "s",
        "spread of settling times, uniform starts",
        later_than_fastest,
        1.0,
        form="{:.3f}",
    ),
    Criterion(
        "tick",
        "Share of tick",
        "%",
        "time of the law alone over a tick of a whole controller on an arm",
        lambda tables: {name: np.array([tables.ticks.get(name, math.nan)]) for name in tables.contenders},
        notable=0.0,
        least=100.0 * MEASURABLE,
        form="{:.1f}",
    ),
    Criterion(
        "memory", "Memory", "numbers", "numbers kept from tick to tick", of_one_law(Tables.memory), form="{:.0f}"
    ),
    Criterion(
        "jump",
        "Jump at 180°",
        "rad",
        "jump of the command across a 180° rotation, over kp",
        of_one_law(lambda tables, name: jump(tables.contenders[name])),
    ),
    Criterion(
        "held",
        "Held by noise from",
        "rad",
        "least worst-case noise tried that traps it at a 180° rotation",
        held_by_noise_from,
        sense=GREATEST,
        form="{:g}",
    ),
    Criterion(
        "effort", "Effort", "rad²/s³", "integral of the squared command, median uniform start", over_uniform("effort")
    ),
    Criterion("peak", "Peak command", "rad/s²", "greatest command of any uniform start", over_uniform("peak_u"), 1.0),
    Criterion(
        "chatter",
        "Change at rest",
        "rad/s²",
        "largest change of the command from tick to tick at rest",
        over_uniform("rest_change"),
        1.0,
    ),
    Criterion(
        "variation",
        "Variation",
        "rad/s²",
        "total variation of the command, median start",
        perturbed("delay", 0.0, "variation"),
    ),
    settled_under(
        "matched", "Settled at equal peak", f" with gains that give a peak of {PEAK:g} rad/s²", "equal-peak", PEAK
    ),
    settled_under("bounded", "Settled with weak motors", f", command cut at {BOUND:g} rad/s²", "saturation", BOUND),
    settled_under("slow", f"Settled at {SLOW_HZ:g} Hz", f", control at {SLOW_HZ:g} Hz", "control-rate", SLOW_HZ),
    settled_under("late", "Settled, late", f", {1e3 * LATE_S:g} ms late", "delay", LATE_S),
    settled_under("heavy", "Settled, heavy", f", inertia {HEAVY:g} times the model's", "inertia", HEAVY),
    settled_under("spinning", "Settled, spinning", f", {SPIN:g} rad/s at the start", "spin", SPIN),
    Criterion(
        "follows",
        "Error behind the goal",
        "rad",
        f"greatest error in the last second, goal moving at {MOVING:g} rad/s",
        perturbed("moving-goal", MOVING, "tail_max_rad"),
        form="{:.2g}",
    ),
    Criterion(
        "noisy",
        "Variation under noise",
        "rad/s²",
        f"total variation of the command, orientation noise {NOISY_RAD:g} rad",
        perturbed("attitude-noise", NOISY_RAD, "variation"),
    ),
    Criterion(
        "arms",
        "Settle on arms",
        "%",
        "uniform starts on arms that settle",
        on_arms("settled"),
        None,
        GREATEST,
        form="{:.1f}",
    ),
    Criterion(
        "within",
        "Within torque and range",
        "%",
        "uniform starts on arms that settle within the motors' rated torques and the joints' ranges",
        on_arms("range"),
        None,
        GREATEST,
        form="{:.1f}",
    ),
)

BY_NAME = {one.name: one for one in CRITERIA}
