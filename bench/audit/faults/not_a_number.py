"""infinite, or not a number.

effect: a command that is no number passes every comparison with a limit, and then reaches the motors
cure: divide by no length that can be zero; keep arguments of acos and sqrt in their range
"""

import numpy as np

from bench.audit.examined import Examined, Found


def find(examined: Examined) -> Found | None:
    """Three numbers of which one is none."""
    answered = np.array([not reason for reason in examined.raised])
    bad = answered & ~np.isfinite(examined.e).all(axis=1)
    places = ", ".join(dict.fromkeys(examined.pairs.place[bad]))
    return examined.first(bad, f"no finite numbers for {bad.sum()} of {len(bad)} pairs ({places})")
