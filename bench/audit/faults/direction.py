"""The other direction than stated."""

from bench.audit.examined import Examined
from bench.audit.fault import Fault, Found


def find(examined: Examined) -> Found | None:
    """e points from R_d to R where the caller wants the opposite, or the reverse."""
    stated, found = examined.stated, examined.convention
    if not found or stated.sign in (None, found.sign):
        return None
    return Found(f"stated to point {stated.sign}, it points {found.sign}: swapped arguments, or another sign")


FAULT = Fault(
    "points the other way",
    "positive feedback: the robot runs away from the goal",
    "swap the arguments, or change the sign",
    "rotation-vector",
    unless=("transpose",),
)
