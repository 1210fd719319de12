"""Test vectors of an export: what our own functions answer, for whoever runs the exported ones elsewhere.

Of a law that takes no sine, cosine or arc every bit is to be met. Of others libraries differ in the last bits, and the
vector says by how much its answer moves when every such call is off by ULPS units in its last place.
"""

import functools
import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from bench.export.entries import Entry, Parameter
from bench.export.shaken import Shaken
from bench.export.subject import Subject, translated
from bench.law.contender import PAPERS_GAINS, Gains
from bench.law.so3 import Rotation, from_quaternion

FIRST, OTHERS = 120, 6
"""Vectors of the first entry, and of every other one: together some 200."""

SEED = 1988
EPS = float(np.finfo(float).eps)
SHAKES = 4
"""How often errors of libm are drawn, for a law that asks it."""

MARGIN, ROUNDED = 4.0, 8.0
"""Of the tolerance over the largest of the drawn deviations, which need not be the worst; and units in the last place
of the answer beside it, for what is computed of other numbers rounds otherwise."""


class State(NamedTuple):
    """Where a law is asked: quaternions (w, x, y, z) of R and R_d, and the angular velocity [rad/s]."""

    kind: str
    quat: np.ndarray
    quat_d: np.ndarray
    omega: np.ndarray


class Vector(NamedTuple):
    """One question and its answer; memory is empty where there is none, tolerance 0 where every bit counts."""

    entry: str
    kind: str
    arguments: dict[str, Any]
    result: list[float]
    memory: list[float]
    tolerance: float


def states(count: int, seed: int = SEED) -> Iterator[State]:
    """Uniform, near and at 180°, near the goal, at the poles of angles, spinning; goals at random and the identity."""
    random = np.random.default_rng(seed)
    for at in range(count):
        axis = _unit(random.normal(size=3))
        goal = np.array([1.0, 0.0, 0.0, 0.0]) if at % 2 else _unit(random.normal(size=4))
        omega = random.normal(size=3)
        place = at % 6
        if place == 0:
            kind, turn = "uniform", _unit(random.normal(size=4))
        elif place == 1:
            kind, turn = "near 180°", _about(axis, math.pi - 10.0 ** random.uniform(-8.0, -1.0))
        elif place == 2:
            kind, turn = "at 180°", np.array([0.0, *np.eye(3)[at // 6 % 3]])
            goal = np.array([1.0, 0.0, 0.0, 0.0])
        elif place == 3:
            kind, turn = "near the goal", _about(axis, 10.0 ** random.uniform(-8.0, -1.0))
        elif place == 4:
            kind, turn = "near a pole", _product(_about(np.array([0.0, 1.0, 0.0]), math.pi / 2.0), _about(axis, 1e-3))
            goal = np.array([1.0, 0.0, 0.0, 0.0])
        else:
            kind, turn, omega = "spinning", _unit(random.normal(size=4)), 10.0 * omega
        yield State(kind, _product(turn, goal), goal, omega)


@functools.lru_cache(maxsize=64)
def vectors(subject: Subject) -> tuple[Vector, ...]:
    """FIRST of the first entry, OTHERS of every other; only questions with a finite answer."""
    found = []
    for place, entry in enumerate(subject.entries):
        wanted = OTHERS if place else FIRST
        random = np.random.default_rng(SEED + place)
        taken = 0
        for state in states(20 * wanted, SEED + place):
            one = _vector(subject, entry, state, random)
            if one is not None:
                found.append(one)
                taken += 1
            if taken == wanted:
                break
    return tuple(found)


def _vector(subject: Subject, entry: Entry, state: State, random: np.random.Generator) -> Vector | None:
    arguments = {one.name: _argument(subject, one, state, random) for one in entry.parameters}
    given = [as_given(one, arguments[one.name]) for one in entry.parameters]
    with np.errstate(all="ignore"):
        answer = flat(entry, entry.function(*_each(given, np.float64)))
        if not np.isfinite(answer).all():
            return None
        tolerance = 0.0
        if not translated(subject).program.is_algebraic:
            moved = max(_deviation(entry, given, answer, shake) for shake in range(SHAKES))
            tolerance = MARGIN * moved + ROUNDED * EPS * max(map(abs, answer))
    size = len(answer) - (len(subject.memory or ()) if entry.has_memory else 0)
    return Vector(entry.name, state.kind, arguments, answer[:size], answer[size:], tolerance)


def _argument(subject: Subject, one: Parameter, state: State, random: np.random.Generator) -> Any:
    """A value for an argument, as JSON has it: a number or a list of numbers, a matrix by rows."""
    quat = state.quat_d if "_d" in one.name else state.quat
    if one.kind == "matrix":
        return np.array(from_quaternion(tuple(quat))).T.reshape(-1).tolist()
    if one.name.startswith("quat"):
        w, *v = (quat * random.uniform(0.5, 2.0)).tolist()
        return [w, *v] if one.name.endswith("wxyz") else [*v, w]
    if one.kind == "gains":
        return list(PAPERS_GAINS)
    if one.kind == "memory":
        return _unit(random.normal(size=4)).tolist() if state.kind != "at 180°" else list(subject.memory or ())
    if one.name in ("inertia", "stiffness"):
        half = random.normal(size=(3, 3))
        return (np.eye(3) + half @ half.T).reshape(-1).tolist()
    if one.kind == "number":
        return float(random.uniform(0.5, 2.0))
    if one.name.startswith("omega"):
        return state.omega.tolist()
    if one.name.startswith("axis"):
        return _unit(random.normal(size=3)).tolist()
    if one.name == "E":
        E = subject.record.chart(from_quaternion(tuple(quat))).E
        return [float(each) for each in E]
    return random.normal(size=one.size).tolist()


def as_given(one: Parameter, value: Any) -> Any:
    """An argument as our functions take it: a matrix by its columns, tuples elsewhere."""
    if one.kind == "matrix":
        return Rotation(*(tuple(value[column::3]) for column in range(3)))
    if one.kind == "gains":
        return Gains(*value)
    return tuple(value) if isinstance(value, list) else value


def flat(entry: Entry, answer: Any) -> list[float]:
    """An answer as numbers: a matrix by rows, then the memory."""
    if entry.returns == "matrix":
        return [float(column[row]) for row in range(3) for column in answer]
    return [float(each) for each in _numbers(answer)]


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, tuple):
        for one in value:
            yield from _numbers(one)
    else:
        yield value


def _each(values: Any, convert: Callable) -> Any:
    """The same tuples with every number converted."""
    if isinstance(values, tuple) and hasattr(values, "_fields"):
        return type(values)(*(_each(one, convert) for one in values))
    if isinstance(values, tuple | list):
        return type(values)(_each(one, convert) for one in values)
    return convert(values)


def _deviation(entry: Entry, given: list, answer: list[float], seed: int) -> float:
    """How far the answer moves when calls of libm are off; 0 if there are none."""
    Shaken.errors = np.random.default_rng(seed)
    moved = flat(entry, entry.function(*_each(given, Shaken)))
    return max(abs(one - other) for one, other in zip(moved, answer, strict=True))


def _unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v)


def _about(axis: np.ndarray, angle: float) -> np.ndarray:
    return np.array([math.cos(angle / 2.0), *(math.sin(angle / 2.0) * axis)])


def _product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    w, v, x, u = p[0], p[1:], q[0], q[1:]
    return np.array([w * x - v @ u, *(w * u + x * v + np.cross(v, u))])
