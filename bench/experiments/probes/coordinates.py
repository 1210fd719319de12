"""Coordinates of an orientation at single ones: B and its condition, poles, the work of moments, linear terms.

omega = B Edot (Murphy 1988, 2.8).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from bench.base.on_first_use import Turn
from bench.experiments.experiment import Unit
from bench.experiments.probe_values.coordinates import (
    ABOUT_Y,
    ANGLE_AND_AXIS,
    AT_POLE,
    BESIDE,
    DECADES,
    FORM_DECADES,
    PAIRS,
    POLE_DECADES,
    TURNS,
    TURNS_ELSEWHERE,
)
from bench.experiments.probes.number import Number, in_coordinates
from bench.experiments.request import Request
from bench.law.contenders.registry import contenders, representation
from bench.law.kinds import Coordinates
from bench.law.so3 import Rotation, from_quaternion
from tasks.haar import axes

ZYX = "zyx-euler"
NEAR_ZERO = ("zyz-euler", "rotation-vector", ANGLE_AND_AXIS)
DIRECTIONS = 12
COMPLEX_STEP = 1e-30
"""Step of the complex-step derivative, which has no cancellation: any tiny number does."""

SHIFT_RAD = 0.7
"""Any amount that no symmetry of the angles shares."""

GRID = 8
"""Values of alpha, and of gamma, at each pole."""

TURNS_OF_ANGLES = 200
"""Haar-random orientations at which the angles' axes are compared."""

SEED = 0
"""Seed of these orientations, in every run."""

AT_RANDOM, NEAR_POLE = "random", "near"

STEP = 2.0 ** (-52 / 3)
"""rad; of a central difference, whose truncation and rounding then are both about its square."""

SINGULAR = 100.0 * 2.0**-52
"""Least singular value of B under which it has no inverse: a hundred roundings."""

FORMS = {
    "zyx-euler": math.pi / 2,
    "xyz-euler": math.pi / 2,
    "zyz-euler": 0.0,
}
"""Forms of Euler angles, and the middle angle at which each is degenerate [rad]."""

LINEAR_STEP = 1e-4
"""rad and rad/s: central differences err by its square, or by rounding over it."""


def matrix_B(along: Coordinates, R: Rotation) -> np.ndarray:
    """Return B of a representation at R: what each coordinate turns the body about, in its columns."""
    at = along.chart(R)
    rates = np.eye(len(at.E)).tolist()
    return np.array(
        [along.angular_velocity(at, tuple(rate)) for rate in rates]
    ).T


def euler_B(R: Rotation) -> np.ndarray:
    """Return B of Z-Y-X angles."""
    return matrix_B(representation(ZYX), R)


def least_of_B(quat: tuple) -> float:
    """Return the smallest singular value of B of Z-Y-X angles at an orientation."""
    return float(
        np.linalg.svd(euler_B(from_quaternion(quat)), compute_uv=False)[-1]
    )


def condition_in(word: str, R: Rotation) -> float:
    """Return the condition number of B of a representation at R."""
    return float(np.linalg.cond(matrix_B(representation(word), R)))


def turn(axis: Sequence[float] | np.ndarray, angle: Any) -> Any:
    """Return the matrix of a rotation by Rodrigues' formula, complex numbers allowed."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)


def condition_of_angle_and_axis(E: np.ndarray) -> float:
    """Compute the condition number for angle and axis: column i is vee(dR/dE_i R^T)."""

    def to_matrix(E: Any) -> Any:
        sine, cosine = np.sin(E[1]), np.cos(E[1])
        return turn(
            (sine * np.cos(E[2]), sine * np.sin(E[2]), cosine), E[0]
        )

    R = to_matrix(E)
    columns = []
    for unit in np.eye(3):
        slope = (
            to_matrix(E + 1j * COMPLEX_STEP * unit).imag
            / COMPLEX_STEP
            @ R.T
        )
        columns.append((slope[2, 1], slope[0, 2], slope[1, 0]))
    return float(np.linalg.cond(np.array(columns).T))


def condition_near_zero(word: str, axis: np.ndarray, angle: float) -> float:
    """Return the condition number in one of NEAR_ZERO of a rotation about an axis."""
    if word == ANGLE_AND_AXIS:
        x, y, z = axis
        return condition_of_angle_and_axis(
            np.array((angle, math.acos(z), math.atan2(y, x)))
        )
    return condition_in(
        word,
        Rotation(
            *(tuple(column) for column in turn(axis, angle).T.tolist())
        ),
    )


def measure_near_zero(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield condition numbers of B of small rotations; at: the angle [rad]."""
    for k in range(DECADES[0], DECADES[1] + 1):
        for i, axis in enumerate(axes(DIRECTIONS)):
            for word in NEAR_ZERO:
                found = condition_near_zero(word, axis, 10.0**-k)
                words = in_coordinates(word)
                yield Number(
                    "condition",
                    found,
                    f"axis-{i:02d}",
                    10.0**-k,
                    words=words,
                )


def measure_about_y(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the least singular value of B after rotations about Y; at: degrees."""
    for degrees, quat in ABOUT_Y.items():
        words = in_coordinates(ZYX)
        yield Number(
            "least_of_B",
            least_of_B(quat),
            f"y{degrees:+d}",
            degrees,
            words=words,
        )


def measure_moved_angles(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield the largest change of R at a pole if alpha and gamma change; at: beta in degrees.

    case: "sum" where their sum stays the same, "difference" where their difference does.
    """
    to_matrix, words = representation(ZYX).to_matrix, in_coordinates(ZYX)
    grid = np.linspace(-3.0, 3.0, GRID).tolist()
    for sign, (what, way) in itertools.product(
        (1, -1), (("sum", -1), ("difference", 1))
    ):
        beta = sign * math.pi / 2
        for i, j in itertools.product(range(GRID), repeat=2):
            before = to_matrix((grid[i], beta, grid[j]))
            after = to_matrix(
                (grid[i] + SHIFT_RAD, beta, grid[j] + way * SHIFT_RAD)
            )
            change = float(np.abs(np.subtract(before, after)).max())
            yield Number(
                "change_of_R",
                change,
                f"{what}-{i}-{j}",
                90.0 * sign,
                words=words,
            )


def random_orientations(count: int, seed: int) -> list[Rotation]:
    """Return uniform ones by the Haar measure: normalized quaternions of four normal numbers."""
    quats = np.random.default_rng(seed).normal(size=(count, 4))
    quats /= np.linalg.norm(quats, axis=1, keepdims=True)
    return [from_quaternion(tuple(quat)) for quat in quats.tolist()]


def measure_axes_of_angles(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield how far the axis of alpha is from the base's z axis, and that of gamma from the hand's x axis."""
    words = in_coordinates(ZYX)
    for k, R in enumerate(random_orientations(TURNS_OF_ANGLES, SEED)):
        B, case = euler_B(R), f"random-{k:03d}"
        alpha, gamma = (
            np.abs(B[:, 0] - (0.0, 0.0, 1.0)),
            np.abs(B[:, 2] - R.n),
        )
        yield Number("alpha_gap", float(alpha.max()), case, words=words)
        yield Number("gamma_gap", float(gamma.max()), case, words=words)


def polar_orientations(
    zyx: Coordinates, seed: int
) -> list[tuple[str, Rotation]]:
    """Return orientations about both poles of Z-Y-X: (exact or near, R), at 10^-1 to 10^-12 rad and exactly."""
    rng, found = np.random.default_rng(seed), []
    for side in (1.0, -1.0):
        for alpha, gamma in rng.uniform(
            -math.pi, math.pi, (BESIDE, 2)
        ).tolist():
            s, c = (
                math.sin(alpha),
                math.cos(alpha),
            )  # gamma adds to alpha on a pole
            on_pole = Rotation(
                (0.0, 0.0, -side), (-s, c, 0.0), (side * c, side * s, 0.0)
            )
            found.append((AT_POLE, on_pole))
            for k in range(1, POLE_DECADES + 1):
                beta = side * (math.pi / 2 - 10.0**-k)
                found.append(
                    (NEAR_POLE, zyx.to_matrix((alpha, beta, gamma)))
                )
    return found


def balance(
    along: Coordinates, R: Rotation, moment: np.ndarray, rates: np.ndarray
) -> dict[str, float]:
    """Compute both sides of (3.10) at R for a moment and rates of the coordinates, each of length 1.

    Returns:
        exists: whether F_E = B^T m is finite. power_gap: |F_E . Edot - m . B Edot|. difference_gap: the same with omega
        from R(E), differenced along Edot. unconverted: the same with the moment not converted (of three coordinates).
        least_of_B: smallest singular value of B; lost: |B^T e| of the moment e of length 1 that it belongs to. gain:
        size of B^-T S B^T with S = diag(1, 0, 0), infinite where B has no inverse.
    """
    at, B = along.chart(R), matrix_B(along, R)
    F_E = np.array(along.generalized(at, tuple(moment.tolist())))
    raw = np.full(len(rates), math.nan)
    if along.about:
        raw = np.array([moment[along.about.index(i)] for i in range(3)])
    ends = [
        along.to_matrix(tuple((at.E + side * STEP * rates).tolist()))
        for side in (1, -1)
    ]
    after, before = (np.array(one).T for one in ends)
    omega = Turn.from_matrix(after @ before.T).as_rotvec() / (2 * STEP)
    moments, sizes, _ = np.linalg.svd(B)
    gain = math.inf
    if B.shape == (3, 3) and sizes[-1] > SINGULAR:
        gain = float(
            np.linalg.norm(np.linalg.inv(B)[0]) * np.linalg.norm(B[:, 0])
        )
    lost = along.generalized(at, tuple(moments[:, -1].tolist()))
    turned = along.angular_velocity(at, tuple(rates.tolist()))
    return {
        "exists": float(np.isfinite(F_E).all()),
        "power_gap": float(abs(F_E @ rates - moment @ turned)),
        "difference_gap": float(abs(F_E @ rates - moment @ omega)),
        "unconverted": float(abs(raw @ rates - moment @ B @ rates)),
        "least_of_B": float(sizes[-1]),
        "lost": float(np.linalg.norm(lost)),
        "gain": gain,
    }


def balances(
    along: Coordinates, places: list[tuple[str, Rotation]], seed: int
) -> Iterator[tuple[str, dict]]:
    """Yield the place, its number, and what `balance` finds there for random directions of moment and rates."""
    rng = np.random.default_rng(seed)
    for k, (place, R) in enumerate(places):
        drawn = rng.normal(size=3), rng.normal(size=len(along.chart(R).E))
        moment, rates = (
            vector / np.linalg.norm(vector) for vector in drawn
        )
        yield f"{place}-{k:04d}", balance(along, R, moment, rates)


def measure_work(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield what `balance` finds of Z-Y-X angles, and the gap of power of every other representation."""
    anywhere = [(AT_RANDOM, R) for R in random_orientations(TURNS, SEED)]
    zyx = representation(ZYX)
    for case, found in balances(
        zyx, anywhere + polar_orientations(zyx, SEED), SEED
    ):
        for measure, value in found.items():
            yield Number(measure, value, case, words=in_coordinates(ZYX))
    for name, along in contenders("representations").items():
        if name != ZYX:
            for case, found in balances(
                along, anywhere[:TURNS_ELSEWHERE], SEED
            ):
                yield Number(
                    "power_gap",
                    found["power_gap"],
                    case,
                    words=in_coordinates(name),
                )


def measure_forms(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield condition numbers of B of forms of Euler angles towards their poles; at: the distance [rad]."""
    outer = np.random.default_rng(0).uniform(-3.0, 3.0, (PAIRS, 2)).tolist()
    for form, at_pole in FORMS.items():
        along = representation(form)
        for i, (first, last) in enumerate(outer):
            for k in range(1, FORM_DECADES + 1):
                R = along.to_matrix((first, at_pole + 10.0**-k, last))
                words = in_coordinates(form)
                yield Number(
                    "condition",
                    condition_in(form, R),
                    f"pair-{i:02d}",
                    10.0**-k,
                    words=words,
                )


def angular_acceleration(
    E: np.ndarray, rates: np.ndarray, u: np.ndarray
) -> np.ndarray:
    """Compute Eddot = B^-1 (u - Bdot Edot), which is (2.11), with Bdot by differences along the motion."""
    to_matrix, h = representation(ZYX).to_matrix, LINEAR_STEP
    here, ahead, behind = (
        euler_B(to_matrix(tuple((E + side * h * rates).tolist())))
        for side in (0, 1, -1)
    )
    return np.linalg.solve(here, u - (ahead - behind) / (2 * h) @ rates)


def measure_linear_terms(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield the derivatives of (2.11) at zero by angles, by rates and by u; case: by what, row and column."""
    h, names = LINEAR_STEP, ("angles", "rates", "input")
    for (place, name), column in itertools.product(
        enumerate(names), range(3)
    ):
        step = np.zeros((3, 3))
        step[place, column] = h
        slope = (
            angular_acceleration(*step) - angular_acceleration(*-step)
        ) / (2 * h)
        for row in range(3):
            yield Number(
                "derivative",
                float(slope[row]),
                f"{name}-{row}{column}",
                words=in_coordinates(ZYX),
            )
