"""zero at 180°.

effect: a robot that starts 180° from its goal stays there, and leaves slowly from nearby
cure: take 1 for the sign of 0, atan2 for an arc sine, the axis from a column of R + R^T; a sine needs another form
law: quaternion-shortest
unless: not-a-number, raises, long-way, misaligned
"""

import numpy as np

from bench.audit.examined import FAULT, NOTE, Examined, Found

ZERO = 1e-6
"""Share of slope times pi: six decades below the requested error; rounding leaves 1e-15, a scalar part of it 1e-8."""
TWENTIETH = 0.05
BEFORE_RAD = 0.01


def find_known(examined: Examined) -> Found | None:
    """|e| is zero at 180°; a property of its form if e dies away before, as sin(theta) does."""
    here = examined.at("at-180")
    dead = here & (examined.size <= ZERO * examined.slope * np.pi)
    near = examined.size[np.abs(examined.pairs.distance - BEFORE_RAD) < 1e-9]
    is_form = examined.form in ("", "sine") and bool(np.nanmedian(near) < TWENTIETH * examined.slope * np.pi)
    text = f"e = 0 for {dead.sum()} of {here.sum()} rotations by exactly 180°"
    if is_form:
        text += "; its form itself vanishes there"
    return examined.first(dead, text, right=not is_form, severity=NOTE if is_form else FAULT)
