"""the error is in the body frame instead of the base frame, or in the base frame instead of the body frame.

effect: near R = I the torque has a wrong axis; far from R = I the robot moves away from the goal
cure: multiply an error in the body frame by R once, before you use the error with quantities in the base frame
law: rotation-matrix
unless: transpose
"""

from collections.abc import Iterator

import numpy as np

from bench.audit.convention import ENOUGH, FRAMES, apart, directions
from bench.audit.examined import EXPLAINED_RAD, Examined, Model, Symptom, explanation
from bench.audit.pairs import Pairs
from bench.audit.rotations import rotated


def find(examined: Examined) -> Symptom | None:
    """Find an error in the other frame than stated, or rotated into none."""
    stated, found = examined.stated, examined.convention
    if found and stated.frame and stated.frame != found.frame:
        return Symptom(
            f"stated to be in the {stated.frame} frame, it is in the {found.frame} frame"
        )
    if not found:
        return explanation(examined, models, "e = {}, which is in no frame")
    (other,) = set(FRAMES) - {found.frame}
    here = np.flatnonzero(examined.at("wide", "close") & (examined.apart > EXPLAINED_RAD))
    line = apart(examined.e, directions(examined.pairs, other))[here]
    is_other = np.minimum(line, np.pi - line) < EXPLAINED_RAD
    if not is_other.sum() > ENOUGH * len(here):
        return None
    where = np.degrees(examined.pairs.angle[here[is_other]])
    text = f"{found.frame} frame, but {other} frame for {is_other.sum()}, at {where.min():.3g}° to {where.max():.3g}°"
    return Symptom(text, examined.evidence(int(here[np.argmax(is_other)])))


def models(pairs: Pairs) -> Iterator[Model]:
    """Yield the axis in base or body, rotated where it must not be, or the wrong way; R_d^T k is R^T k."""
    R, k = pairs.R, pairs.axis
    T, k_body = R.swapaxes(1, 2), rotated(R.swapaxes(1, 2), k)
    yield "R applied to an error that is in base already", rotated(R, k)
    yield "R_d applied to an error that is in base already", rotated(pairs.R_d, k)
    yield "R^T applied to an error that is in body already", rotated(T, k_body)
    yield "R_d^T applied to an error that is in body already", rotated(pairs.R_d.swapaxes(1, 2), k_body)
