"""the error is a difference of Euler angles, not a vector along an axis.

effect: the robot takes a detour that depends on the orientation; at gimbal lock a tiny error can cause a large rotation
cure: use an error along the axis of the rotation; or convert angle rates to angular velocity, and avoid gimbal lock
unless: quaternion-order, transpose, frame
"""

import functools
import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from bench.audit.convention import ENOUGH
from bench.audit.examined import Examined, Symptom
from bench.audit.pairs import Pairs
from bench.audit.rotations import to_euler

SEQUENCES = tuple("".join(axes) for axes in itertools.permutations("XYZ"))
SAME_RAD = 1e-5
"""Largest difference of each angle: single precision has 1e-6."""


def find(examined: Examined) -> Symptom | None:
    """Three angles, or differences of them, about axes that are not at right angles."""
    angles = find_angles(examined)
    if angles is None:
        return None
    here = np.flatnonzero(examined.at("wide"))
    worst = int(here[np.argmax(np.abs(examined.e[here]).max(axis=1))])
    text = f"e is {angles.how} (intrinsic {angles.sequence}): no axis, and a pole where the middle angle is 90°"
    return Symptom(text, examined.evidence(worst, False))


class Angles(NamedTuple):
    """A match: sequence of intrinsic axes, how e is put together, and the angles (n x 3) that e is modulo 2 pi."""

    sequence: str
    how: str
    values: np.ndarray


@functools.lru_cache(maxsize=2)
def find_angles(examined: Examined) -> Angles | None:
    """Return the Euler sequence that explains e, as angles or as their difference; or None."""
    if examined.form:
        return None
    here = examined.pairs.chosen(examined.at("wide"))
    e = examined.e[examined.at("wide")]
    for sequence in SEQUENCES:
        orders = dict.fromkeys(((0, 1, 2), (2, 1, 0), tuple(int(i) for i in np.argsort(list(sequence)))))
        for how, angles in combined(here, sequence):
            for order, sign in itertools.product(orders, (1.0, -1.0)):
                values = sign * angles[:, order]
                off = e - values
                off -= 2.0 * np.pi * np.round(off / (2.0 * np.pi))  # whole turns apart
                if np.mean(np.abs(off).max(axis=1) < SAME_RAD) >= ENOUGH:
                    return Angles(sequence, how, values)
    return None


def combined(of: Pairs, sequence: str) -> Iterator[tuple[str, np.ndarray]]:
    """(words, angles n x 3) for each way to make an error of them."""
    R, R_d = of.R, of.R_d
    yield "the difference of angles of R_d and R", to_euler(sequence, R_d) - to_euler(sequence, R)
    for words, X in (("R_d R^T", R_d @ R.swapaxes(1, 2)), ("R^T R_d", R.swapaxes(1, 2) @ R_d)):
        yield f"the angles of {words}", to_euler(sequence, X)
        yield f"the angles of ({words})^T", to_euler(sequence, X.swapaxes(1, 2))
