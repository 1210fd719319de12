"""a jump elsewhere than at 180°.

effect: the command jumps while the robot passes, and chatters if it rests there
cure: let the two sides meet; only at 180° no error can be continuous
unless: long-way, deadband, euler-angles
"""

import numpy as np

from bench.audit.examined import Evidence, Examined, Found, inputs
from bench.audit.pairs import CUBE_AXES, Pairs, diagonal, drawn_axes, drawn_orientations, made

SEED = 11
STEP_DEG = 1.0
SUSPECT = 0.02
"""Difference of neighbours, beyond that of theta k itself, from which on a jump is looked for between them."""
STEEPER = 1.2
"""Than both its neighbours: a step across a jump is; that of a form which grows without bound is not."""
WIDTH_RAD = 1e-9
JUMP = 1e-3
"""A difference over WIDTH_RAD; the steepest form, 2 tan(theta/2) at 179°, changes by 1e-5 there."""


def find_known(examined: Examined) -> Found | None:
    """Along rotations from 1 to 179° about some axes: neighbours apart, and still so when they come together."""
    rng, angle = np.random.default_rng(SEED), np.radians(np.arange(1.0, 179.5, STEP_DEG))
    begins = np.vstack((diagonal(3), drawn_orientations(rng, 5)))
    for q, axis in zip(begins, np.vstack((CUBE_AXES[[0, 6, 18]], drawn_axes(rng, 5))), strict=True):
        e = examined.evaluate(along(q, axis, angle)).e
        step = np.linalg.norm(np.diff(e, axis=0), axis=1) / examined.slope
        beside = np.fmax(np.append(step[1:], 0.0), np.insert(step[:-1], 0, 0.0))
        suspects = np.flatnonzero((step > np.radians(STEP_DEG) + SUSPECT) & (step > STEEPER * beside))
        for i in suspects:
            low, high = narrowed(examined, q, axis, angle[i], angle[i + 1])
            ends = along(q, axis, np.array((low, high)))
            said = examined.evaluate(ends).e
            size = float(np.linalg.norm(said[1] - said[0])) / examined.slope
            if size > JUMP:
                (_, now), (_, goal) = inputs(examined.takes, ends)
                right = examined.known(ends)[1][1]
                evidence = Evidence(now, goal, said[1], right if np.isfinite(right).all() else "")
                return Found(f"e jumps by {size:.3g} at {np.degrees(high):.6g}°", evidence)
    return None


def along(q: np.ndarray, axis: np.ndarray, angle: np.ndarray) -> Pairs:
    """Pairs from one orientation about one axis."""
    count = len(angle)
    return made("line", np.tile(q, (count, 1)), np.tile(axis, (count, 1)), np.cos(angle / 2.0), np.sin(angle / 2.0))


def narrowed(examined: Examined, q: np.ndarray, axis: np.ndarray, low: float, high: float) -> tuple[float, float]:
    """Bisection, into the half with the larger difference."""
    while high - low > WIDTH_RAD:
        middle = 0.5 * (low + high)
        first, second, third = examined.evaluate(along(q, axis, np.array((low, middle, high)))).e
        if np.linalg.norm(second - first) > np.linalg.norm(third - second):
            high = middle
        else:
            low = middle
    return low, high
