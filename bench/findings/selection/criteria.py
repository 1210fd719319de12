"""What is measured of a law: criteria.toml says what each number means, a function here computes it from tables."""

import functools
import math
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bench.findings.claims.adequacy import NOISE
from bench.findings.claims.standing import MEASURABLE
from bench.findings.on_arms import passed
from bench.findings.selection.tables import Tables, by_law
from bench.law.contender import Contender
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.so3 import from_quaternion
from tasks.haar import axes

NOTABLE = 0.01
"""Differences below a hundredth are no reason to choose a law."""

Measure = Callable[[Tables], dict[str, np.ndarray]]
"""tables -> law: values, all laws' in the order of the same starts; a law that was not asked is missing."""


class Criterion(NamedTuple):
    """One number of a law, from one value a start (or from one value alone).

    level: the quantile that is taken of the values, 1 the largest; or "mean". greater: more is better. notable, least:
    relative and absolute difference up to which two laws tie.
    """

    name: str
    meaning: str
    measure: Measure
    level: float | str = 0.5
    greater: bool = False
    notable: float = NOTABLE
    least: float = 0.0

    @property
    def sense(self) -> float:
        """Return the factor by which less is better."""
        return -1.0 if self.greater else 1.0


LATE_S = 0.02
"""The delay at which laws are compared, the largest [s]."""


def over_uniform(column: str) -> Measure:
    """Return a column of all uniform starts; infinite where the law does not settle."""
    return lambda tables: by_law(tables.uniform, column, math.inf)


def perturbed(axis: str, level: float, column: str) -> Measure:
    """Return a column at one level of a perturbation; infinite where the law does not settle."""

    def measure(tables: Any) -> Any:
        rows = tables.robustness
        rows = rows[(rows["axis"] == axis) & (rows["level"] == level) & rows["contender"].isin(tables.contenders)]
        return by_law(rows.sort_values("start_id", kind="stable"), column, math.inf)

    return measure


def longest_path(tables: Tables) -> dict[str, np.ndarray]:
    """Return the longest path over the geodesic, from uniform starts and 180° rotations."""
    half_turns = tables.directed[tables.directed["start_set"] == "half-turn"]
    ways = [by_law(rows, "path_ratio") for rows in (tables.uniform, half_turns)]
    return {name: np.array([np.nanmax(np.concatenate([way[name] for way in ways]))]) for name in ways[0]}


def held_by_noise_from(tables: Tables) -> dict[str, np.ndarray]:
    """Return the least noise tried that holds a law at some 180° rotation; infinite if none does."""
    rows = tables.robustness
    rows = rows[(rows["axis"] == NOISE) & rows["contender"].isin(tables.contenders)]
    least = rows["level"].where(rows["lost"], math.inf).groupby(rows["contender"], observed=True).min()
    return {str(name): np.array([level]) for name, level in least.items()}


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
    gains, goal = Tuning(np.float64(1.0), np.float64(2.0)), Goal()
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


def on_arms(measure: str) -> Measure:
    """Return 100 for each episode on arms from uniform starts that passes one of `on_arms.MEASURES`, else 0 [%]."""

    def measured(tables: Any) -> Any:
        rows = tables.arms[tables.arms["contender"].isin(tables.contenders)]
        return by_law(rows.assign(passed_percent=100.0 * passed(rows)[measure]), "passed_percent")

    return measured


MEASURES: dict[str, Measure] = {
    "unsettled": lambda tables: {name: 100.0 * lost for name, lost in by_law(tables.uniform, "lost").items()},
    "lost": lambda tables: {name: np.array([lost.sum()]) for name, lost in by_law(tables.directed, "lost").items()},
    "detour": longest_path,
    **dict.fromkeys(("time", "worst"), over_uniform("settling_time_s")),
    "tick": lambda tables: {name: np.array([tables.ticks.get(name, math.nan)]) for name in tables.contenders},
    "memory": lambda tables: {name: np.array([tables.memory(name)]) for name in tables.contenders},
    "held": held_by_noise_from,
    "effort": over_uniform("effort"),
    "peak": over_uniform("peak_u"),
    "variation": perturbed("delay", 0.0, "variation"),
    "late": perturbed("delay", LATE_S, "settling_time_s"),
    "arms": on_arms("settled"),
    "within": on_arms("range"),
}


CRITERIA = tuple(
    Criterion(name, measure=MEASURES[name], least=100.0 * MEASURABLE if name == "tick" else 0.0, **words)
    for name, words in tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")).items()
)
"""The criteria of criteria.toml with their measures; differences in time a tick tie below MEASURABLE."""
BY_NAME = {one.name: one for one in CRITERIA}
