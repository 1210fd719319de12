"""How each criterion is measured: functions of a run's tables to one value a law and start."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from bench.findings.on_arms import passed
from bench.findings.selection.tables import Tables, by_law
from bench.law.contender import AT_REST, Contender, Gains, Goal
from bench.law.so3 import from_quaternion
from tasks.sphere import axes

NOISE = "half-turn-noise"


def of_one_law(measure: Callable[[Tables, str], float]) -> Callable[[Tables], dict[str, np.ndarray]]:
    """A measure from a function of one law."""
    return lambda tables: {name: np.array([measure(tables, name)]) for name in tables.contenders}


def over_uniform(column: str) -> Callable[[Tables], dict[str, np.ndarray]]:
    """A column of all uniform starts; infinite where the law does not settle."""
    return lambda tables: by_law(tables.uniform, column, math.inf)


def perturbed(axis: str, level: float, column: str) -> Callable[[Tables], dict[str, np.ndarray]]:
    """A column at one level of a perturbation; infinite where the law does not settle."""

    def measure(tables):
        rows = tables.robustness
        rows = rows[(rows["axis"] == axis) & (rows["level"] == level) & rows["contender"].isin(tables.contenders)]
        return by_law(rows.sort_values("start_id", kind="stable"), column, math.inf)

    return measure


def later_than_fastest(tables: Tables) -> dict[str, np.ndarray]:
    """How much later each uniform start settles than the law's fastest [s]; infinite where it does not settle."""
    times = by_law(tables.uniform, "settling_time_s", math.inf)
    return {name: values - min(values[np.isfinite(values)], default=0.0) for name, values in times.items()}


def longest_path(tables: Tables) -> dict[str, np.ndarray]:
    """Longest path over the geodesic, from uniform starts and 180° rotations."""
    half_turns = tables.directed[tables.directed["start_set"] == "half-turn"]
    ways = [by_law(rows, "path_ratio") for rows in (tables.uniform, half_turns)]
    return {name: np.array([np.nanmax(np.concatenate([way[name] for way in ways]))]) for name in ways[0]}


def held_by_noise_from(tables: Tables) -> dict[str, np.ndarray]:
    """Return the least noise tried that holds a law at some 180° rotation; infinite if none does."""
    rows = tables.robustness[tables.robustness["axis"] == NOISE]
    found = {}
    for name, own in rows[rows["contender"].isin(tables.contenders)].groupby("contender", observed=True):
        holding = own.loc[own["lost"], "level"]
        found[str(name)] = np.array([holding.min() if len(holding) else math.inf])
    return found


BESIDE_RAD, DIRECTIONS = 1e-6, 16


@functools.cache
def jump(one: Contender) -> float:
    """Return the jump of the command where a body at rest is pushed through a 180° rotation, over kp [rad].

    On coordinates: not a number, for a chart of SO(3) jumps somewhere else as well; nor of a user's law, which must not
    be called here. What a law remembers goes with it.
    """
    if one.representation is not None or one.regulator.origin:
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


def on_arms(measure: str) -> Callable[[Tables], dict[str, np.ndarray]]:
    """100 for each episode on arms from uniform starts that passes one of `on_arms.MEASURES`, 0 for the others [%]."""

    def measured(tables):
        rows = tables.arms[tables.arms["contender"].isin(tables.contenders)]
        return by_law(rows.assign(passed_percent=100.0 * passed(rows)[measure]), "passed_percent")

    return measured
