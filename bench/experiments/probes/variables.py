"""What three variables of an orientation can and cannot be: paths, eliminations, sets of values, straight lines.

Oracle: scipy's rotations.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np

from bench.base.on_first_use import Turn
from bench.experiments.experiment import Unit
from bench.experiments.probe_values.variables import (
    LEGS,
    MATRICES,
    PAIRS,
    STEPS,
    WAYS,
)
from bench.experiments.probes.number import Number
from bench.experiments.request import Request

LOOPS_RAD = (0.1, 0.5, 1.0, math.pi / 2)

POSSIBLE = 1e-12
"""Rounding of a determinant of order 1: some hundred roundings."""

MIDDLE_RAD = 0.8
"""A middle angle at which no form of Euler angles is degenerate."""

FORMS = tuple(
    "".join(axes)
    for axes in itertools.product("XYZ", repeat=3)
    if axes[0] != axes[1] != axes[2]
)
"""The twelve forms of Euler angles, each turn about an axis of the body."""


def after(legs: Sequence) -> Turn:
    """Compute the orientation after turns in the base frame, one after the other."""
    return functools.reduce(
        lambda at, leg: Turn.from_rotvec(leg) * at, legs, Turn.identity()
    )


def measure_ways(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield what integrals of the angular velocity miss [rad]; at: the angle of a loop's turns [rad].

    way_difference: of two ways with the same ends. left_after_loop: the rotation after turns about x, y, -x and -y.
    one_axis_gap: of turns about one axis.
    """
    rng = np.random.default_rng(request.seed)
    end, between = Turn.random(WAYS, rng=rng), Turn.random(WAYS, rng=rng)
    by_way = between.as_rotvec() + (end * between.inv()).as_rotvec()
    for k, apart in enumerate(
        np.linalg.norm(end.as_rotvec() - by_way, axis=1).tolist()
    ):
        yield Number("way_difference_rad", apart, f"way-{k:03d}")
    x, y = np.eye(3)[:2]
    for a in LOOPS_RAD:
        left = after([a * x, a * y, -a * x, -a * y]).magnitude()
        yield Number("left_after_loop_rad", float(left), "loop", a)
    axes = rng.normal(size=(WAYS, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    angles = rng.uniform(-3, 3, (WAYS, LEGS))
    for k in range(WAYS):
        legs = angles[k][:, None] * axes[k]
        missed = (
            Turn.from_rotvec(legs.sum(axis=0)).inv() * after(legs)
        ).magnitude()
        yield Number("one_axis_gap", float(missed), f"axis-{k:03d}")


def divisor(R: np.ndarray, trio: tuple[int, ...]) -> np.ndarray:
    """Compute the determinant of the derivatives of (2.5) by three of n_x, n_y, n_z, o_x, o_y, o_z, over 4."""
    n, o = R[:, :, 0], R[:, :, 1]
    zero = np.zeros_like(n)
    rows = [
        np.hstack([2 * n, zero]),
        np.hstack([zero, 2 * o]),
        np.hstack([o, n]),
    ]
    return np.linalg.det(np.stack(rows, axis=1)[:, :, list(trio)]) / 4


def product(R: np.ndarray, trio: tuple[int, ...]) -> np.ndarray:
    """Compute the same by theory: an element of the column with one eliminated, times one of a = n x o."""
    of_n, of_o = [i for i in trio if i < 3], [i - 3 for i in trio if i >= 3]
    alone, pair = (of_o, of_n) if len(of_n) == 2 else (of_n, of_o)
    third = 3 - sum(pair)
    sign = -1.0 if third != 1 else 1.0
    return sign * R[:, alone[0], 1 if alone is of_o else 0] * R[:, third, 2]


def another(R: np.ndarray, trio: tuple[int, ...]) -> np.ndarray:
    """Return rotations with the same three elements left: two of one column reflected about the other column's two."""
    of_n = [i for i in trio if i < 3]
    column, pair = (
        (0, of_n)
        if len(of_n) == 2
        else (1, [i - 3 for i in trio if i >= 3])
    )
    other = R.copy()
    kept = R[:, pair, 1 - column]
    along = kept / np.linalg.norm(kept, axis=1)[:, None]
    part = R[:, pair, column]
    other[:, pair, column] = (
        2 * (part * along).sum(axis=1)[:, None] * along - part
    )
    other[:, :, 2] = np.cross(other[:, :, 0], other[:, :, 1])
    return other


def measure_eliminations(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield of every three elements of n and o what their elimination divides by, and a second matrix without them.

    case: the places of the three. largest_divisor: 0 where they cannot be eliminated. divisor_gap: to a product of two
    elements. second_gap: to (2.5). second_difference: the median of the largest element's difference from R.
    """
    R = Turn.random(
        MATRICES, rng=np.random.default_rng(request.seed)
    ).as_matrix()
    for trio in itertools.combinations(range(6), 3):
        case, by = "".join(map(str, trio)), divisor(R, trio)
        largest = float(np.abs(by).max())
        yield Number("largest_divisor", largest, case)
        if largest <= POSSIBLE:
            continue
        second = another(R, trio)
        both = second[
            :, :, :2
        ]  # n and o, of which (2.5) says that they are orthonormal
        left = np.abs(both.swapaxes(1, 2) @ both - np.eye(2)).max()
        apart = np.median(np.abs(second - R).max(axis=(1, 2)))
        yield Number(
            "divisor_gap", float(np.abs(by - product(R, trio)).max()), case
        )
        yield Number("second_gap", float(left), case)
        yield Number("second_difference", float(apart), case)


def by_angles(sequence: str, angles: np.ndarray) -> np.ndarray:
    """Return matrices of Euler angles; lower case letters turn about axes of the base."""
    with np.errstate(all="ignore"):
        return Turn.from_euler(sequence, angles).as_matrix()


def by_axis(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return matrices of rotations about axes."""
    return Turn.from_rotvec(axis * angle).as_matrix()


SETS = ("Z-Y-X", "Z-Y-Z", "roll, pitch and yaw", "angle and axis")
"""Representations of which two sets of values are compared."""


def measure_sets(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield how far apart matrices of two sets of values are, and of many sets at a degenerate orientation."""
    rng = np.random.default_rng(request.seed)
    sets = rng.uniform(0.1, 1.4, (MATRICES, 3))
    flipped = (sets + np.array((np.pi, 0.0, np.pi))) * np.array(
        (1.0, -1.0, 1.0)
    )
    mirrored = flipped + np.array((0.0, np.pi, 0.0))
    angle, axis = sets[:, :1], sets / np.linalg.norm(sets, axis=1)[:, None]
    shifts = rng.uniform(-3.0, 3.0, (MATRICES, 1))
    pole, zero = np.full_like(shifts, np.pi / 2), np.zeros_like(shifts)
    pairs = (
        (by_angles("ZYX", sets), by_angles("ZYX", mirrored)),
        (by_angles("ZYZ", sets), by_angles("ZYZ", flipped)),
        (
            by_angles("xyz", sets[:, ::-1]),
            by_angles("xyz", mirrored[:, ::-1]),
        ),
        (by_axis(axis, angle), by_axis(-axis, -angle)),
    )
    many = (
        by_angles("ZYX", np.hstack([shifts, pole, shifts])),
        by_angles("ZYZ", np.hstack([shifts, zero, -shifts])),
        by_angles("xyz", np.hstack([shifts, pole, shifts])),
        by_axis(axis, zero),
    )
    for name, (first, second), degenerate in zip(
        SETS, pairs, many, strict=True
    ):
        yield Number(
            "two_sets_gap", float(np.abs(first - second).max()), name
        )
        yield Number(
            "many_sets_gap",
            float(np.abs(degenerate - degenerate[0]).max()),
            name,
        )


def least_of(form: str, angles: tuple[float, float, float]) -> float:
    """Compute the smallest singular value of B: its columns are the axes of the three turns in the base."""
    axes = np.eye(3)[["XYZ".index(letter) for letter in form]]
    first = Turn.from_euler(form[0], angles[0])
    second = first * Turn.from_euler(form[1], angles[1])
    B = np.array([axes[0], first.apply(axes[1]), second.apply(axes[2])]).T
    return float(np.linalg.svd(B, compute_uv=False)[-1])


def measure_twelve_forms(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield the least singular value of B of every form; at: the middle angle, where degenerate and elsewhere [rad]."""
    outer = (
        np.random.default_rng(request.seed)
        .uniform(-3.0, 3.0, (PAIRS, 2))
        .tolist()
    )
    for form, (k, (first, last)) in itertools.product(
        FORMS, enumerate(outer)
    ):
        degenerate = 0.0 if form[0] == form[2] else np.pi / 2
        for measure, middle in (
            ("least_degenerate_gap", degenerate),
            ("least_regular", MIDDLE_RAD),
        ):
            found = least_of(form, (first, middle, last))
            yield Number(measure, found, f"{form}-{k:02d}", middle)


def measure_lines(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield lengths of straight lines in Z-Y-X angles over the shortest, and how unevenly errors turn the hand.

    unevenness: the greatest over the least rotation by errors of one length; singular values of B are 1 and
    sqrt(1 -+ |sin beta|).
    """
    rng = np.random.default_rng(request.seed)
    start, end = (Turn.random(MATRICES, rng=rng) for _ in range(2))
    shortest = (end * start.inv()).magnitude()
    first, last = (one.as_euler("ZYX") for one in (start, end))
    ways = [
        Turn.from_euler("ZYX", first + s * (last - first))
        for s in np.linspace(0.0, 1.0, STEPS)
    ]
    steps = [
        (later * before.inv()).magnitude()
        for before, later in itertools.pairwise(ways)
    ]
    ratios = np.sum(steps, axis=0) / shortest
    tilts = np.abs(np.sin(first[:, 1]))
    uneven = np.sqrt((1 + tilts) / (1 - tilts))
    for k in range(MATRICES):
        yield Number("length_ratio", float(ratios[k]), f"pair-{k:03d}")
        yield Number("unevenness", float(uneven[k]), f"pair-{k:03d}")
