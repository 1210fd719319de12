"""Digits lost near the goal."""

import numpy as np

from bench.audit.fault import FAULT as IS_FAULT
from bench.audit.fault import NOTE, Fault, Found
from bench.audit.pairs import IDENTITY, NEAR_IDENTITY

LARGEST_RAD = 0.01
LOST = 1e-9
"""Of slope times a radian: rounding leaves 1e-16 here, an arc cosine 1e-8."""
COUNT_RAD = 2.0 * np.pi / 2**24
"""An error below this is none to a robot: one count of an encoder of 24 bits, 3.7e-7 rad."""


def find(examined) -> Found | None:
    """|e - slope theta k| of the smallest rotations; a note if no encoder shows it."""
    if not examined.convention:
        return None
    angle = examined.pairs.angle
    here = examined.at(NEAR_IDENTITY, IDENTITY) & (angle <= LARGEST_RAD)
    expected = examined.slope * angle[:, None] * examined.direction
    # Forms leave the rotation vector with the cube of the angle, those of a size of their own perhaps with its square.
    bound = LOST + (0.0 if examined.convention.form else 1.0) * angle**2
    truth = examined.truth if examined.convention.form else expected
    error = np.where(here, np.linalg.norm(examined.e - truth, axis=1), 0.0) / examined.slope
    with np.errstate(invalid="ignore"):
        lost = error > bound
    if not lost.any():
        return None
    worst = int(np.argmax(np.where(lost, error, 0.0)))
    text = f"off by up to {error[worst]:.2g} rad, at {angle[worst]:.2g} rad"
    is_felt = error[worst] > COUNT_RAD
    return Found(
        text if is_felt else f"{text}: less than a count of an encoder of 24 bits",
        examined.evidence(worst),
        IS_FAULT if is_felt else NOTE,
    )


FAULT = Fault(
    "digits-near-0",
    "digits lost near the goal",
    "the command flickers, or is zero, at the goal",
    "no arc cosine of a trace or scalar part: atan2 of the vector's length and the scalar keeps every digit",
    "rotation-vector",
    find,
    unless=("single-precision", "deadband", "euler-angles", "norm-clip", "axis-clip", "long-way"),
)
