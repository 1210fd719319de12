"""the error points away from the goal.

effect: the feedback is positive, and the robot runs away from the goal
cure: swap the two arguments, or change the sign of the error
unless: transpose
"""

from bench.audit.examined import Examined, Symptom


def find(examined: Examined) -> Symptom | None:
    """e points from R_d to R where the caller wants the opposite, or the reverse."""
    stated, found = examined.stated, examined.convention
    if not found or stated.sign in (None, found.sign):
        return None
    return Symptom(
        f"stated to point {stated.sign}, it points {found.sign}: swapped arguments, or another sign"
    )
