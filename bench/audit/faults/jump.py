"""the error jumps at an angle other than 180°.

effect: the command jumps when the robot passes this angle, and chatters if the robot rests at this angle
cure: make the error continuous at this angle; only at 180° a jump is unavoidable
unless: long-way, deadband, euler-angles, frame, misaligned, axis-at-180
"""

import numpy as np

from bench.audit.examined import COUNT_RAD, Examined, PairEvidence, Symptom, inputs
from bench.audit.pairs import CUBE_AXES, Pairs, diagonal, drawn_axes, drawn_orientations, made

SEED = 11
ANGLES_DEG = np.concatenate((np.geomspace(1e-4, 1.0, 17)[:-1], np.arange(1.0, 179.5), (179.5,)))
SUSPECT, SUSPECTS = 1e-4, 3
"""Change of e/theta beyond that of its neighbours, of the slope, from which on a jump is looked for; places a line."""
WIDTH_RAD = 1e-9
JUMP = 1e-3
"""A difference over WIDTH_RAD, of e up to a radian; the steepest form, 2 tan(theta/2), changes by 1e-5 at 179°."""
NOISE = 30.0
"""Times what most answers are off the axis."""


def find_known(examined: Examined) -> Symptom | None:
    """Along rotations from 1e-4 to 179.5° about some axes: neighbours apart, and still so when they come together."""
    rng, angle = np.random.default_rng(SEED), np.radians(ANGLES_DEG)
    begins = np.vstack((diagonal(3), drawn_orientations(rng, 5)))
    for q, axis in zip(begins, np.vstack((CUBE_AXES[[0, 6, 18]], drawn_axes(rng, 5))), strict=True):
        step = np.diff(examined.evaluate(along(q, axis, angle)).e / angle[:, None], axis=0)
        bend = np.linalg.norm(step[1:-1] - 0.5 * (step[:-2] + step[2:]), axis=1) / examined.slope
        for i in np.argsort(-np.nan_to_num(bend), kind="stable")[:SUSPECTS]:
            if not bend[i] > SUSPECT:
                break
            low, high = narrowed(examined, q, axis, angle[i + 1], angle[i + 2])
            ends = along(q, axis, np.array((low, high)))
            said = examined.evaluate(ends).e
            size = float(np.linalg.norm(said[1] - said[0])) / examined.slope
            if size > max(JUMP * min(high, 1.0), COUNT_RAD, NOISE * examined.noise):
                (_, now), (_, goal) = inputs(examined.takes, ends)
                right = examined.known(ends)[1][1]
                evidence = PairEvidence(
                    now, goal, said[1], right if np.isfinite(right).all() else ""
                )
                return Symptom(f"e jumps by {size:.3g} at {np.degrees(high):.6g}°", evidence)
    return None


def along(q: np.ndarray, axis: np.ndarray, angle: np.ndarray) -> Pairs:
    """Pairs from one orientation about one axis."""
    count = len(angle)
    return made("line", np.tile(q, (count, 1)), np.tile(axis, (count, 1)), np.cos(angle / 2.0), np.sin(angle / 2.0))


def narrowed(examined: Examined, q: np.ndarray, axis: np.ndarray, low: float, high: float) -> tuple[float, float]:
    """Bisection, into the half where e/theta changes more."""
    while high - low > WIDTH_RAD:
        angle = np.array((low, 0.5 * (low + high), high))
        first, second, third = examined.evaluate(along(q, axis, angle)).e / angle[:, None]
        is_first = np.linalg.norm(second - first) > np.linalg.norm(third - second)
        low, high = (low, angle[1]) if is_first else (angle[1], high)
    return low, high
