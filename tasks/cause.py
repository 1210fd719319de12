"""Say why an arm's episode failed: what it came near to, which is no proof.

The bounds are twice as far in as the start set `clear` ever comes. An arm may pass such a place and fail of something
else.
"""

from __future__ import annotations

# Edot = B^-1 omega is up to 1/margin times as fast as the tool turns: ten times here, 6 degrees from a pole.
NEAR_MARGIN = 0.1
# Joints turn up to so many times faster, a radian for a metre, than the tool does.
NEAR_CONDITION = 100.0

CAUSES = ("", "representation", "kinematic", "both", "torque", "law")


def cause(outcome: str, min_margin: float, condition: float) -> str:
    """Return the cause of a failure, one of CAUSES, from the outcome, least margin (NaN: none) and greatest condition.

    "torque": no singularity was near, and the torque rule ended it; "law": none of these, as at an equilibrium away
    from the goal or a jump of the coordinates, and whatever was near if the law crashed or hung.
    """
    if outcome == "settled":
        return ""
    if outcome in ("crashed", "hung"):
        return "law"
    near_representation, near_kinematic = min_margin < NEAR_MARGIN, not condition <= NEAR_CONDITION
    if near_representation and near_kinematic:
        return "both"
    if near_representation:
        return "representation"
    if near_kinematic:
        return "kinematic"
    return "torque" if outcome in ("saturated", "singular") else "law"
