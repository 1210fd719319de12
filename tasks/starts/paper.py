"""One start for each response figure of the paper (Murphy 1988, figures 2.3 to 2.5).

The text gives no initial orientations and the scan no figures: these are ours. 2.3: the rotation-matrix regulator far
from a 180° rotation. 2.4: the linearized Euler regulator at angles "much larger than might be expected", inside its
range. 2.5: the feedback-linearized regulator near the limits of the range on which its response is linear.
"""

from __future__ import annotations

from tasks.base import Start, StartSet
from tasks.rotations import zyx

# alpha, beta, gamma [rad]
FIGURES = {"2.3": (1.2, 0.6, -0.9), "2.4": (1.2, -0.8, 2.2), "2.5": (2.6, 1.2, -2.8)}


def build(seed: int) -> list[Start]:
    """Return the three starts."""
    return [Start(f"figure-{figure}", zyx(*angles)) for figure, angles in FIGURES.items()]


STARTS = StartSet("paper", "One start per response figure; ours, the paper states none", len(FIGURES), build)
