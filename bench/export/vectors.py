"""Test vectors of an export: arguments of its entries, and what the benchmark's own functions answer."""

import functools
import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from bench.export.entries import Entry, Parameter
from bench.export.subject import Subject, translated
from bench.law.inputs import PAPERS_GAINS, Gains, Tuning
from bench.law.so3 import Rotation, from_quaternion
from tasks.base import IDENTITY, Quat
from tasks.rotations import about, multiply

FIRST, OTHERS = 120, 15
"""Vectors of the first entry, and of every other one: together some 200 for a law."""

BOUNDS, DELAY_S = (1.0, 100.0), 0.005
"""Bounds of a law that reads one [rad/s^2]: at the paper's gains 0.01 to 1 kp. The delay is one of five ticks [s]."""

SEED = 1988
CLOSE = 1e-7
"""Tolerance over the largest number of the answer, for a law that calls libm. Libraries differ in last bits; vectors
lie as near as 1e-8 rad to 180° rotations, and some laws divide by that distance, which leaves half of the digits."""


class VectorState(NamedTuple):
    """A state of a body: quaternions (w, x, y, z) of R and R_d, and the angular velocity [rad/s]."""

    kind: str
    quat: Quat
    quat_d: Quat
    omega: np.ndarray


class Vector(NamedTuple):
    """Arguments and their answer; memory is empty where there is none, tolerance 0 where every bit counts."""

    entry: str
    kind: str
    arguments: dict[str, Any]
    result: list[float]
    memory: list[float]
    tolerance: float

    @property
    def row(self) -> list[float]:
        """Return arguments, result, memory and tolerance as one row of numbers."""
        return [float(x) for x in np.hstack([*self.arguments.values(), self.result, self.memory, self.tolerance])]


def states(count: int, seed: int = SEED) -> Iterator[VectorState]:
    """Yield states: uniform, near and at 180°, near the goal, at the poles of angles, spinning."""
    random = np.random.default_rng(seed)
    for at in range(count):
        axis = tuple(random.normal(size=3).tolist())
        drawn, goal = _unit(random), _unit(random) if at % 2 else IDENTITY
        kind, turn, faster = (
            ("uniform", drawn, 1.0),
            ("near 180°", about(axis, math.pi - 10.0 ** random.uniform(-8.0, -1.0)), 1.0),
            ("at 180°", about(tuple(np.eye(3)[at // 6 % 3].tolist()), math.pi), 1.0),
            ("near the goal", about(axis, 10.0 ** random.uniform(-8.0, -1.0)), 1.0),
            ("near a pole", multiply(about((0.0, 1.0, 0.0), math.pi / 2.0), about(axis, 1e-3)), 1.0),
            ("spinning", drawn, 10.0),
        )[at % 6]
        goal = IDENTITY if kind in ("at 180°", "near a pole") else goal
        yield VectorState(kind, multiply(turn, goal), goal, faster * random.normal(size=3))


@functools.lru_cache(maxsize=64)
def vectors(subject: Subject) -> tuple[Vector, ...]:
    """Return FIRST vectors of the first entry and OTHERS of every other, those with finite answers only."""
    return tuple(make_vectors(subject))


def make_vectors(subject: Subject) -> Iterator[Vector]:
    """Yield them one by one."""
    close = 0.0 if translated(subject).is_algebraic else CLOSE
    for place, entry in enumerate(subject.entries):
        wanted = OTHERS if place else FIRST
        random = np.random.default_rng(SEED + place)
        made = (_vector(subject, entry, one, random, close) for one in states(20 * wanted, SEED + place))
        finite = (one for one in made if np.isfinite([*one.result, *one.memory]).all())
        yield from (one for one, _ in zip(finite, range(wanted), strict=False))


def _vector(
    subject: Subject, entry: Entry, state: VectorState, random: np.random.Generator, close: float
) -> Vector:
    arguments = {one.name: _argument(subject, one, state, random) for one in entry.parameters}
    with np.errstate(all="ignore"):
        answer = entry.function(*(_as_given(one, arguments[one.name]) for one in entry.parameters))
    result, memory = answer if entry.has_memory else (answer, ())
    numbers = np.transpose(result) if entry.returns.kind == "matrix" else np.array(result)
    flat = numbers.astype(float).ravel().tolist()
    tolerance = close * max(map(abs, flat)) if close else 0.0
    return Vector(entry.name, state.kind, arguments, flat, list(map(float, memory)), tolerance)


def _argument(
    subject: Subject, one: Parameter, state: VectorState, random: np.random.Generator
) -> Any:
    """Return a value for an argument, as JSON has it: a number or a list of numbers, a matrix by rows."""
    quat = state.quat_d if "_d" in one.name else state.quat
    name = one.name.removesuffix("_body").removesuffix("_wxyz")
    if one.kind == "matrix":
        return np.array(from_quaternion(quat)).T.ravel().tolist()
    if one.kind == "gains":
        return list(PAPERS_GAINS)
    if one.kind == "tuning":
        return [*PAPERS_GAINS, float(random.uniform(*BOUNDS)), DELAY_S]
    if one.kind == "memory":
        return list(subject.memory or ()) if state.kind == "at 180°" else list(_unit(random))
    if one.kind == "rows":  # symmetric and positive, as an inertia and a stiffness are
        half = random.normal(size=(3, 3))
        return (np.eye(3) + half @ half.T).ravel().tolist()
    if one.kind == "number":
        return float(random.uniform(0.5, 2.0))
    if name == "omega":
        return state.omega.tolist()
    if name == "E":
        return [float(each) for each in subject.record.chart(from_quaternion(quat)).E]
    return random.normal(size=one.size).tolist()


def _as_given(one: Parameter, value: Any) -> Any:
    """Return an argument as the benchmark's functions take it: a matrix by columns, tuples, numbers of NumPy."""
    numbers = np.array(value)
    if one.kind == "matrix":
        return Rotation(*map(tuple, numbers.reshape(3, 3).T))
    if one.kind == "gains":
        return Gains(*numbers)
    if one.kind == "tuning":
        return Tuning(*numbers)
    return tuple(numbers) if numbers.ndim else np.float64(value)


def _unit(random: np.random.Generator) -> Quat:
    q = random.normal(size=4)
    return tuple((q / np.linalg.norm(q)).tolist())
