"""body for base, or base for body.

effect: beside R = I the torque has another axis than the error; far from there the robot leaves the goal
cure: rotate a body-frame error by R before it meets base-frame quantities, once
law: rotation-matrix
unless: transpose
"""

from collections.abc import Iterator

from bench.audit.examined import Examined, Found, Model, explanation, rotated
from bench.audit.pairs import Pairs


def find(examined: Examined) -> Found | None:
    """Find an error in the other frame than stated, or rotated into none."""
    stated, found = examined.stated, examined.convention
    if found and stated.frame and stated.frame != found.frame:
        return Found(f"stated to be in the {stated.frame} frame, it is in the {found.frame} frame")
    return explanation(examined, models, "e = {}, which is in no frame")


def models(pairs: Pairs) -> Iterator[Model]:
    """Yield the axis in base or body, rotated where it must not be, or the wrong way; R_d^T k is R^T k."""
    R, k = pairs.R, pairs.axis
    T, k_body = R.swapaxes(1, 2), rotated(R.swapaxes(1, 2), k)
    yield "R applied to an error that is in base already", rotated(R, k)
    yield "R_d applied to an error that is in base already", rotated(pairs.R_d, k)
    yield "R^T applied to an error that is in body already", rotated(T, k_body)
    yield "R_d^T applied to an error that is in body already", rotated(pairs.R_d.swapaxes(1, 2), k_body)
