"""The poses at which Jacobians are looked at: some with names, many at random, a slice, and ways to the Z-Y-X pole.

    named     the keyframes of the arm's file: home, and what its literature calls by a name
    random    spread evenly over the joint ranges
    slice     two joints varied on a grid, the others at home, so that singularities can be drawn
    pole      postures brought to beta = +-(pi/2 - 10^-k), the tool's position, alpha and gamma held, and on it

Limitations: an arm without a well-conditioned posture on the pole gets no `pole` poses.
"""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tasks.arm_model import Arm
from tasks.arm_starts.uniform import spread
from tasks.base import Quat
from tasks.haar import halton
from tasks.kinematics import Kinematics
from tasks.linear_algebra import least_norm
from tasks.paths import cos_beta, zyx_angles
from tasks.rotations import zyx


class JointPose(NamedTuple):
    """Joint angles [rad] and what they are called."""

    set: str
    id: str
    q: tuple[float, ...]


WELL_CONDITIONED = 50.0
"""The largest condition number of J (metres, radians) at which the arm is not to blame; as claim C18 has it."""

FAMILIES, TRIES = 4, 200
"""Postures brought to each of the two poles, and how many are tried for them."""

DECADES = 12
"""10^-12 is the last distance at which a double has digits left for the Jacobian: cos(beta) is known to 1e-16."""

STRIDE = 0.05
"""rad between points on the way to the pole: Newton's method converges from there away from singularities."""

COARSE = 13
"""Points a side of the grid on which a pair of joints is chosen."""


def poses(arm: Arm, count: int, seed: int) -> list[JointPose]:
    """Return every set; `random` has so many poses, the slice about twice as many."""
    kin = Kinematics(arm)
    return [*named(arm), *random(arm, count, seed), *sliced(kin, math.isqrt(2 * count) | 1), *pole(kin, seed)]


def named(arm: Arm) -> list[JointPose]:
    """Return the keyframes."""
    return [JointPose("named", name, q) for name, q in arm.poses]


def random(arm: Arm, count: int, seed: int) -> list[JointPose]:
    """Return a scrambled Halton sequence over the joint ranges."""
    points = enumerate(halton(count, arm.joints, seed))
    return [
        JointPose("random", f"{i:04d}", tuple(spread(arm, point).tolist())) for i, point in points
    ]


def sliced(kin: Kinematics, side: int) -> list[JointPose]:
    """Return a grid of the two joints that `pair` chooses; the id names them and the place, as in q4-q5-07-33."""
    i, j = pair(kin)
    return [
        JointPose("slice", f"q{i + 1}-q{j + 1}-{row:02d}-{column:02d}", q)
        for (row, column), q in grid(kin.arm, i, j, side)
    ]


def grid(arm: Arm, i: int, j: int, side: int) -> Iterator[tuple[tuple[int, int], tuple[float, ...]]]:
    """(row, column) and the joint angles, joints i and j over their ranges and the others at home."""
    for row, column in itertools.product(range(side), repeat=2):
        point = [0.5] * arm.joints
        point[i], point[j] = (column + 0.5) / side, (row + 0.5) / side
        q, over = list(arm.home), spread(arm, point)
        q[i], q[j] = float(over[i]), float(over[j])
        yield (row, column), tuple(q)


def pair(kin: Kinematics) -> tuple[int, int]:
    """Return the two joints whose grid comes nearest to both kinds of singularity, by the larger of two distances.

    These are the least 1/cond J over the middle joint, and the least cos(beta) where J is well conditioned.
    """
    return min(itertools.combinations(range(kin.arm.joints), 2), key=lambda two: _distance(kin, *two))


def _distance(kin: Kinematics, i: int, j: int) -> float:
    seen = [(kin.condition(q), cos_beta(kin.pose(q)[1])) for _, q in grid(kin.arm, i, j, COARSE)]
    conditions, margins = (np.array(numbers) for numbers in zip(*seen, strict=True))
    well = margins[conditions <= WELL_CONDITIONED]
    return max(float(np.median(conditions) / conditions.max()), float(well.min())) if len(well) else math.inf


def pole(kin: Kinematics, seed: int) -> list[JointPose]:
    """FAMILIES postures to each pole; ids as in 2-plus-1e-05 and 2-minus-exact."""
    found = []
    for name, sign in (("plus", 1.0), ("minus", -1.0)):
        ways = (towards_pole(kin, spread(kin.arm, point), sign) for point in halton(TRIES, kin.arm.joints, seed))
        for family, way in enumerate(itertools.islice(filter(None, ways), FAMILIES)):
            for k, q in enumerate(way, start=1):
                distance = f"1e-{k:02d}" if k <= DECADES else "exact"
                found.append(JointPose("pole", f"{family}-{name}-{distance}", q))
    return found


def towards_pole(kin: Kinematics, q: np.ndarray, sign: float) -> list[tuple[float, ...]] | None:
    """Return the poses at 10^-1 to 10^-12 from beta = sign pi/2, and on it; None if the arm does not get there well."""
    if kin.condition(q) > WELL_CONDITIONED:
        return None
    p, quat = kin.pose(q)
    alpha, beta, gamma = zyx_angles(quat)
    last = sign * (math.pi / 2 - 0.1)
    strides = max(2, math.ceil(abs(last - beta) / STRIDE))
    betas = [beta + (last - beta) * i / strides for i in range(1, strides)]
    betas += [sign * (math.pi / 2 - 10.0**-k) for k in range(1, DECADES + 1)] + [sign * math.pi / 2]
    way = kin.follow(q, [zyx(alpha, b, gamma) for b in betas])
    if way is None:
        return None
    near = [polished(kin, at, p, zyx(alpha, b, gamma)) for at, b in zip(way, betas, strict=True)][strides - 1 :]
    if all(kin.condition(at) <= WELL_CONDITIONED and kin.within_range(at) for at in near):
        return [tuple(at.tolist()) for at in near]
    return None


def polished(kin: Kinematics, q: np.ndarray, p: np.ndarray, quat: Quat) -> np.ndarray:
    """One more step of Newton's method: from the 1e-12 at which `reach` is content to rounding."""
    step = least_norm(kin.jacobian(q), kin.error(q, p, quat))
    return q if step is None else q + step
