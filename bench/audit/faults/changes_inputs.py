"""it changes its inputs.

effect: the controller's own pose or goal is another after the call, and what is computed next is wrong
cure: copy what is changed inside: R = R.copy()
law: rotation-matrix
"""

from bench.audit.examined import Examined, Found


def find(examined: Examined) -> Found | None:
    """Find inputs that differ after the call."""
    text = f"{examined.changed.sum()} of {len(examined.changed)} calls changed the orientations that they were given"
    return examined.first(examined.changed, text, right=False)
