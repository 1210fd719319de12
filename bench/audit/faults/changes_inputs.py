"""it changes its inputs.

effect: the controller's own pose or goal is another after the call, and what is computed next is wrong
cure: copy what is changed inside: R = R.copy()
law: rotation-matrix
"""

import numpy as np

from bench.audit.examined import Examined
from bench.audit.fault import Found


def find(examined: Examined) -> Found | None:
    """Find inputs that differ after the call."""
    if not examined.changed.any():
        return None
    i = int(np.argmax(examined.changed))
    text = f"{examined.changed.sum()} of {len(examined.changed)} calls changed the orientations that they were given"
    return Found(text, examined.evidence(i, False))
