"""the error is zero at 180°.

effect: a robot that starts 180° from its goal stays there; a robot that starts close to 180° starts to move slowly
cure: let the sign of zero be 1, use atan2 instead of an arc sine, or take the axis from the longest column of
  E + E^T + (1 - trace E) I, for E = R_d R^T; do not use the sine of the angle as the length of the error
law: quaternion-shortest
unless: not-a-number, raises, long-way, misaligned
"""

import numpy as np

from bench.audit.examined import Examined, Symptom

ZERO = 1e-6
"""Share of slope times pi: six decades below the requested error; rounding leaves 1e-15, a scalar part of it 1e-8."""
TWENTIETH = 0.05
BEFORE_RAD = 0.01
CURE_OF_A_FORM = (
    "take another form, as twice the vector part of q_d q*, with the sign of its scalar part and 1 for the sign of 0; "
    "if the goal is never 180° away, allow dead-at-180"
)


def find_known(examined: Examined) -> Symptom | None:
    """|e| is zero at 180°, by rounding or a sign of 0, or because its form dies away there, as sin(theta) does."""
    at_180 = examined.at("at-180")
    dead = at_180 & (examined.size <= ZERO * examined.slope * np.pi)
    found = examined.first(dead, f"e = 0 for {dead.sum()} of {at_180.sum()} rotations by exactly 180°")
    if found is None or not is_of_the_form(examined):
        return found
    # What its form says is zero, too: there is no right answer to print beside it.
    evidence = found.evidence and found.evidence._replace(right="")
    return found._replace(text=f"{found.text}: its form is zero there", evidence=evidence, cure=CURE_OF_A_FORM)


def is_of_the_form(examined: Examined) -> bool:
    """Tell whether the error dies away before 180°, as a form that is zero there does."""
    near = examined.size[np.abs(examined.pairs.distance - BEFORE_RAD) < 1e-9]
    dies_away = bool(np.nanmedian(near) < TWENTIETH * examined.slope * np.pi)
    return examined.form in ("", "sine") and dies_away
