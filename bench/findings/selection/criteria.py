"""What is measured of a law: criteria as data, each with what it means and how it is computed from a run's tables."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.findings.claims.adequacy import CALL_PRICE, NOISE
from bench.findings.selection.tables import Tables, by_law
from bench.law.contender import AT_REST, Contender, Gains, Goal
from bench.law.so3 import from_quaternion
from tasks.sphere import axes

LEAST, GREATEST = 1.0, -1.0
"""Which is better."""

NOTABLE = 0.01
"""Differences below a hundredth are no reason to choose a law."""


class Criterion(NamedTuple):
    """One number of a law, from one value a start (or from one value alone).

    measure(tables) -> law: values, all laws' in the order of the same starts; a law that was not asked is missing.
    level: the quantile that is taken of the values; None: their mean. sense: LEAST or GREATEST is better.
    notable: relative difference below which two laws are alike. form: how the number is written.
    """

    name: str
    title: str
    unit: str
    meaning: str
    measure: Callable[[Tables], dict[str, np.ndarray]]
    level: float | None = 0.5
    sense: float = LEAST
    notable: float = NOTABLE
    form: str = "{:.3g}"


def _alone(measure: Callable[[Tables, str], float]) -> Callable[[Tables], dict[str, np.ndarray]]:
    """A criterion's measure from a function of one law."""
    return lambda tables: {name: np.array([measure(tables, name)]) for name in tables.contenders}


def _uniform(column: str) -> Callable[[Tables], dict[str, np.ndarray]]:
    return lambda tables: by_law(tables.uniform, column, math.inf)


def _uniform_worst(column: str) -> Callable[[Tables], dict[str, np.ndarray]]:
    def measure(tables):
        return {name: np.array([values.max()]) for name, values in by_law(tables.uniform, column, math.inf).items()}

    return measure


def _troubled(axis: str, level: float, column: str) -> Callable[[Tables], dict[str, np.ndarray]]:
    """A column at one level of an axis of trouble; infinite where the law does not settle."""

    def measure(tables):
        rows = tables.robustness
        rows = rows[(rows["axis"] == axis) & (rows["level"] == level) & rows["contender"].isin(tables.contenders)]
        return by_law(rows.sort_values("start_id", kind="stable"), column, math.inf)

    return measure


def _spread(tables: Tables) -> dict[str, np.ndarray]:
    times = by_law(tables.uniform, "settling_time_s", math.inf)
    return {
        name: np.array([values.max() - values.min() if np.isfinite(values).all() else math.inf])
        for name, values in times.items()
    }


def _detour(tables: Tables) -> dict[str, np.ndarray]:
    half_turns = tables.directed[tables.directed["start_set"] == "half-turn"]
    ways = [by_law(rows, "path_ratio") for rows in (tables.uniform, half_turns)]
    return {name: np.array([np.nanmax(np.concatenate([way[name] for way in ways]))]) for name in ways[0]}


def _held_from(tables: Tables) -> dict[str, np.ndarray]:
    """Least noise that was tried and holds a law at some half turn; infinite if none does."""
    rows = tables.robustness[tables.robustness["axis"] == NOISE]
    found = {}
    for name, own in rows[rows["contender"].isin(tables.contenders)].groupby("contender", observed=True):
        holding = own.loc[own["lost"], "level"]
        found[str(name)] = np.array([holding.min() if len(holding) else math.inf])
    return found


def _memory(tables: Tables, name: str) -> float:
    return float(sum(1 for _ in tables.contenders[name].regulator.memory or ()))


BESIDE_RAD, DIRECTIONS = 1e-6, 16


@functools.cache
def jump(one: Contender) -> float:
    """How far the command jumps where a body at rest is pushed through a half turn, over kp [rad].

    On coordinates: not a number, for a chart of SO(3) jumps somewhere else as well. What a law remembers goes with it.
    """
    if one.representation is not None:
        return math.nan
    return max(_across(one, axis) for axis in axes(DIRECTIONS))


def _across(one: Contender, axis: np.ndarray) -> float:
    gains, goal = Gains(np.float64(1.0), np.float64(2.0)), Goal()
    memory = one.regulator.memory
    commands = []
    with np.errstate(all="ignore"):
        for angle in (math.pi - BESIDE_RAD, math.pi + BESIDE_RAD):
            quat = (math.cos(angle / 2), *(math.sin(angle / 2) * axis))
            R = from_quaternion(tuple(map(np.float64, quat)))
            found = one.law(R, AT_REST, goal, gains, *(() if memory is None else (memory,)))
            u, memory = (found, None) if memory is None else found
            commands.append(np.array(u))
    return float(np.linalg.norm(commands[1] - commands[0]))


def _arms(tables: Tables) -> dict[str, np.ndarray]:
    lost = by_law(tables.arms[tables.arms["contender"].isin(tables.contenders)], "lost")
    return {name: 100.0 * values for name, values in lost.items()}


SLOW_HZ, LATE_S, BOUND, PEAK, HEAVY, SPIN, SWAY, NOISY_RAD = 20.0, 0.02, 10.0, 100.0, 2.0, 20.0, 10.0, 0.01
"""The level of each axis of trouble at which laws are asked: the hardest, but for peak (the paper's own, at kp = 100)
and for noise, where it is what a cheap sensor has."""

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
        "directed starts that do not settle, exact half turns, poles and jumps of coordinates among them",
        lambda tables: {name: np.array([lost.sum()]) for name, lost in by_law(tables.directed, "lost").items()},
    ),
    Criterion(
        "detour", "Longest way", "", "longest way over the shortest, from uniform starts and half turns", _detour
    ),
    Criterion(
        "time",
        "99 % settled in",
        "s",
        "time in which 99 % of the uniform starts settle",
        _uniform("settling_time_s"),
        0.99,
        form="{:.3f}",
    ),
    Criterion(
        "worst",
        "Slowest start",
        "s",
        "settling time of the slowest uniform start",
        _uniform_worst("settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "spread",
        "Slowest less fastest",
        "s",
        "slowest less fastest settling time, uniform starts",
        _spread,
        form="{:.3f}",
    ),
    Criterion(
        "cost",
        "Cost",
        "flops",
        f"operations a tick, a call counted as {CALL_PRICE:g}",
        _alone(Tables.costing),
        notable=0.0,
        form="{:.0f}",
    ),
    Criterion(
        "dearest",
        "Cost of the worst branch",
        "flops",
        "the same on the dearest branch",
        _alone(lambda tables, name: tables.costing(name, "worst")),
        notable=0.0,
        form="{:.0f}",
    ),
    Criterion("memory", "Memory", "numbers", "numbers kept from tick to tick", _alone(_memory), form="{:.0f}"),
    Criterion(
        "jump",
        "Jump at a half turn",
        "rad",
        "jump of the command across a half turn, over kp",
        _alone(lambda tables, name: jump(tables.contenders[name])),
    ),
    Criterion(
        "held",
        "Held by noise from",
        "rad",
        "least worst-case noise tried that holds it at a half turn",
        _held_from,
        sense=GREATEST,
        form="{:g}",
    ),
    Criterion(
        "effort", "Effort", "rad²/s³", "integral of the squared command, median uniform start", _uniform("effort")
    ),
    Criterion("peak", "Peak command", "rad/s²", "greatest command of any uniform start", _uniform_worst("peak_u")),
    Criterion(
        "variation",
        "Variation",
        "rad/s²",
        "total variation of the command, median start",
        _troubled("delay", 0.0, "variation"),
    ),
    Criterion(
        "matched",
        "Settled at equal peak",
        "s",
        f"median settling time with gains that give a peak of {PEAK:g} rad/s²",
        _troubled("equal-peak", PEAK, "settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "bounded",
        "Settled with weak motors",
        "s",
        f"median settling time, command cut at {BOUND:g} rad/s²",
        _troubled("saturation", BOUND, "settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "slow",
        f"Settled at {SLOW_HZ:g} Hz",
        "s",
        f"median settling time, asked {SLOW_HZ:g} times a second",
        _troubled("control-rate", SLOW_HZ, "settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "late",
        "Settled, late",
        "s",
        f"median settling time, {1e3 * LATE_S:g} ms late",
        _troubled("delay", LATE_S, "settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "heavy",
        "Settled, heavy",
        "s",
        f"median settling time, inertia {HEAVY:g} times the model's",
        _troubled("inertia", HEAVY, "settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "spinning",
        "Settled, spinning",
        "s",
        f"median settling time, {SPIN:g} rad/s at the start",
        _troubled("spin", SPIN, "settling_time_s"),
        form="{:.3f}",
    ),
    Criterion(
        "follows",
        "Error behind the goal",
        "rad",
        f"greatest error in the last second, goal swaying at {SWAY:g} rad/s",
        _troubled("moving-goal", SWAY, "tail_max_rad"),
        form="{:.2g}",
    ),
    Criterion(
        "noisy",
        "Variation under noise",
        "rad/s²",
        f"total variation of the command, orientation noise {NOISY_RAD:g} rad",
        _troubled("attitude-noise", NOISY_RAD, "variation"),
    ),
    Criterion(
        "arms", "Arm episodes lost", "%", "uniform starts on arms that do not settle", _arms, None, form="{:.1f}"
    ),
)

BY_NAME = {one.name: one for one in CRITERIA}
