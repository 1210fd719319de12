"""Why an arm's episode failed, as far as the judge can see: near what was it?

Near the representation's singular set, if the margin fell under NEAR_MARGIN; near a kinematic singularity, if the
condition number of the tool's Jacobian (SI units) rose above NEAR_CONDITION. Both are twice as far in as the start set
`clear` ever comes. A cause is where an episode came to, not
a proof: an arm may pass such a place and fail of something else.
"""

from __future__ import annotations

# Edot = B^-1 omega is up to 1/margin times as fast as the tool turns: ten times here, 6 degrees from a pole.
NEAR_MARGIN = 0.1
# Joints turn up to so many times faster, a radian for a metre, than the tool does.
NEAR_CONDITION = 100.0

CAUSES = ("", "representation", "kinematic", "both", "torque", "law")


def cause(outcome: str, min_margin: float, condition: float) -> str:
    """Return the cause of a failure, in a word; empty for an episode that settled.

    "both" singularities were near; "torque": neither, and the torque rule ended it; "law": none of these, as at an
    equilibrium away from the goal or a jump of the coordinates, and whatever was near if the law crashed or hung.

    Args:
        outcome: one of verdict.OUTCOMES.
        min_margin: smallest margin of the representation, NaN if the law has none.
        condition: largest condition number of the Jacobian that was seen.
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
