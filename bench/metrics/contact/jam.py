"""Whether the peg is stuck: it is not in, and goes no further."""

import numpy as np

from bench.metrics.contact_force import insertion
from bench.metrics.contact_metric import ContactMetric, Pose
from tasks.domains.peg_in_hole import DEPTH

# A peg this near to the bottom is in: a tenth of the way is the chamfer's, and its lower face may stand askew.
IN = 0.9 * DEPTH
# A peg stands if it has moved by less [m] in the last tenth of the episode: at that rate it takes ten times the episode
# to go all the way. Soft contacts creep under friction.
STILL = 0.01 * DEPTH


def measure(pose: Pose) -> float:
    """1 if the peg is stuck at the end, 0 if it is in or still on its way; NaN if there is no peg."""
    depth = insertion(pose)
    if depth is None:
        return np.nan
    late = depth[-max(2, len(depth) // 10) :]
    return float(depth[-1] < IN and late.max() - late.min() < STILL)


METRIC = ContactMetric("jam", "jam", "1", "share of pegs that are stuck", measure)
