"""the function changes its inputs.

effect: after the call, the pose or the goal of the controller is changed, and later results of the controller are wrong
cure: copy each input before the function changes it: R = R.copy()
law: rotation-matrix
"""

from bench.audit.examined import Examined, Symptom


def find(examined: Examined) -> Symptom | None:
    """Find inputs that differ after the call."""
    text = f"{examined.changed.sum()} of {len(examined.changed)} calls changed the orientations that they were given"
    return examined.first(examined.changed, text, right=False)
