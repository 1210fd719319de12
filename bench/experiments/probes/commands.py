"""Laws called at single states: errors at the run's starts, and commands at poles, near them and at jumps.

The error is e of (2.12), the command of the rotation-matrix law at rest over Kp.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

import tasks
from bench.experiments.experiment import Unit
from bench.experiments.probe_values.commands import (
    EXACT_RAD,
    GROWTH_DECADES,
)
from bench.experiments.probes.coordinates import euler_B
from bench.experiments.probes.number import Number, in_coordinates
from bench.experiments.probes.turns import FEEDBACK, MATRIX, about
from bench.experiments.request import Request
from bench.law.contenders.registry import find_contender, representation
from bench.law.inputs import AT_REST, PAPERS_GAINS, Gains, Goal
from bench.law.so3 import IDENTITY, Rotation, cross, from_quaternion
from tasks.base import Start
from tasks.haar import axes
from tasks.truth import angle

START_SETS = (
    "uniform",
    "box",
    "goals",
    "half-turn",
    "paper",
    "poles",
    "tumbling",
    "wraps",
)
"""Start sets that every suite has of the paper's laws in continuous time."""

UNIFORM = 1000
"""Uniform starts, as the quick suite and the default one have."""

AWAY_RAD = 1e-3
"""The search for a zero of e stays so far from the goal and from 180°."""

SEARCHES = 16

SPIN = (4.0, -8.0, 6.0)
"""rad/s, any direction: the terms that grow, about 58 / cos(beta), then exceed the spring term 100 pi from cos(beta) =
0.1 on."""

PAIRS = ((1.0, -0.5), (-2.0, 1.0))
"""alpha and gamma near the poles [rad]."""

SIDES = ((0.0, 0.0), (0.4, 0.3), (-0.9, -1.5))
"""beta and the other angle at the jumps [rad], as in the start sets."""

JUMP_RAD = 1e-9


def doubles(numbers: Iterable) -> Any:
    """Return nested tuples with numpy's doubles, for which 1/0 is infinite as in every engine."""
    inside = [
        doubles(x) if isinstance(x, tuple) else np.float64(x)
        for x in numbers
    ]
    return (
        type(numbers)(*inside)
        if hasattr(numbers, "_fields")
        else tuple(inside)
    )


def command(
    contender: str,
    R: Rotation,
    omega: Any = AT_REST,
    R_d: Rotation = IDENTITY,
    gains: Gains = PAPERS_GAINS,
) -> np.ndarray:
    """Return u of a law at one state [rad/s^2]."""
    law = find_contender(contender).law
    goal = doubles(Goal(R_d))
    with np.errstate(all="ignore"):
        return np.array(
            law(doubles(R), doubles(omega), goal, doubles(gains))
        )


def size(vector: np.ndarray) -> float:
    """Return the length of a vector."""
    return float(np.linalg.norm(vector))


def error(R: Rotation, R_d: Rotation = IDENTITY) -> np.ndarray:
    """Return e of (2.12)."""
    return command(MATRIX, R, R_d=R_d) / PAPERS_GAINS.kp


def exact_error(R: Rotation, R_d: Rotation) -> list[Fraction]:
    """Return e of (2.12) of the same doubles, without rounding."""
    found = [Fraction(0)] * 3
    for column, goal in zip(R, R_d, strict=True):
        c, d = [Fraction(x) for x in column], [Fraction(x) for x in goal]
        for i in range(3):
            found[i] += (c[i - 2] * d[i - 1] - c[i - 1] * d[i - 2]) / 2
    return found


def largest_product(R: Rotation) -> float:
    """Return the largest of the three cross products of (2.12), goal zero."""
    return max(
        size(np.array(cross(c, d)))
        for c, d in zip(R, IDENTITY, strict=True)
    )


def starts(request: Request) -> list[Start]:
    """Return every start that the suites have of the paper's laws, UNIFORM uniform ones."""
    found: list[Start] = []
    for name in START_SETS:
        found += tasks.start_set(
            name, UNIFORM if name == "uniform" else None, request.seed
        )
    return found


def is_exact_pole(R: Rotation) -> bool:
    """Tell whether beta is +-90 degrees to EXACT_RAD."""
    beta = representation("zyx-euler").chart(R).E[1]
    return math.pi / 2 - abs(beta) <= EXACT_RAD


def measure_errors(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield |e|, the largest cross product, and the rounding of e at every start; at: the angle to the goal [rad]."""
    words = find_contender(MATRIX).words
    for start in starts(request):
        R, R_d = (
            from_quaternion(start.quat_wxyz),
            from_quaternion(start.goal_wxyz),
        )
        e = error(R, R_d)
        exact = exact_error(R, R_d)
        gaps = [
            abs(Fraction(float(x)) - y)
            for x, y in zip(e, exact, strict=True)
        ]
        at = angle(start.quat_wxyz, start.goal_wxyz)
        yield Number("error", size(e), start.id, at, words=words)
        yield Number(
            "largest_product", largest_product(R), start.id, at, words=words
        )
        yield Number(
            "rounding_gap", float(max(gaps)), start.id, at, words=words
        )


def rotation_by(vector: Sequence[float]) -> Rotation:
    """Return R of a rotation vector."""
    return from_quaternion(about(vector, size(np.asarray(vector))))


def ratio(vector: Sequence[float]) -> float:
    """Return |e| over the sine of the angle; 2, which is more than any ratio, near the goal and 180°."""
    turn = size(np.asarray(vector))
    if not AWAY_RAD < turn < math.pi - AWAY_RAD:
        return 2.0
    return size(error(rotation_by(vector))) / math.sin(turn)


def search_errors(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the lowest |e| over the sine of the angle that a search finds from each of some orientations."""
    from scipy.optimize import minimize

    words = find_contender(MATRIX).words
    for k, axis in enumerate(axes(SEARCHES)):
        lowest = minimize(
            ratio,
            1.5 * axis,
            method="Nelder-Mead",
            options={"maxiter": 200},
        )
        case = f"search-{k:02d}"
        yield Number("evaluations", float(lowest.nfev), case, words=words)
        yield Number("least_ratio", float(lowest.fun), case, words=words)
        yield Number(
            "error", size(error(rotation_by(lowest.x))), case, words=words
        )


def measure_at_poles(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the commands at exact poles, at rest and spinning, and the largest element of B there."""
    words = find_contender(FEEDBACK).words
    for start in tasks.start_set("poles", None, request.seed):
        R = from_quaternion(start.quat_wxyz)
        if not is_exact_pole(R):
            continue
        rest = command(FEEDBACK, R, gains=request.gains)
        spinning = command(FEEDBACK, R, SPIN, gains=request.gains)
        yield Number("u_at_rest", size(rest), start.id, words=words)
        yield Number("u_spinning", size(spinning), start.id, words=words)
        yield Number(
            "largest_of_B",
            float(np.abs(euler_B(R)).max()),
            start.id,
            words=words,
        )


def measure_near_poles(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield |u| of a spinning body near the poles; at: cos(beta)."""
    zyx, words = representation("zyx-euler"), find_contender(FEEDBACK).words
    low, high = GROWTH_DECADES
    for k, sign, pair in itertools.product(
        range(low, high + 1), (1, -1), range(len(PAIRS))
    ):
        alpha, gamma = PAIRS[pair]
        R = zyx.to_matrix((alpha, sign * (math.pi / 2 - 10.0**-k), gamma))
        u = command(FEEDBACK, R, SPIN, gains=request.gains)
        case = f"{'plus' if sign > 0 else 'minus'}-1e-{k:02d}-{pair}"
        yield Number(
            "u_spinning", size(u), case, float(zyx.margin(R)), words=words
        )


def measure_jumps(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield |change of u| as alpha, or gamma, passes 180°, from 1e-9 rad before it to 1e-9 rad behind."""
    to_matrix, words = (
        representation("zyx-euler").to_matrix,
        find_contender(FEEDBACK).words,
    )
    for side, (beta, other) in enumerate(SIDES):
        for name in ("alpha", "gamma"):
            ends = []
            for sign in (1, -1):
                turn = sign * (math.pi - JUMP_RAD)
                angles = (
                    (turn, beta, other)
                    if name == "alpha"
                    else (other, beta, turn)
                )
                ends.append(
                    command(
                        FEEDBACK, to_matrix(angles), gains=request.gains
                    )
                )
            yield Number(
                "u_jump",
                size(ends[0] - ends[1]),
                f"{name}-{side}",
                words=words,
            )


def measure_B(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the largest element of B at every start, and its two least singular values at exact poles."""
    words = in_coordinates("zyx-euler")
    for start in starts(request):
        R = from_quaternion(start.quat_wxyz)
        B = euler_B(R)
        yield Number(
            "largest_of_B", float(np.abs(B).max()), start.id, words=words
        )
        if is_exact_pole(R):
            values = np.linalg.svd(B, compute_uv=False)
            yield Number(
                "second_of_B", float(values[1]), start.id, words=words
            )
            yield Number(
                "least_of_B", float(values[2]), start.id, words=words
            )
