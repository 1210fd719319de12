"""the error is infinite or not a number.

effect: comparisons with limits do not stop a command that is not a number, so this command reaches the motors
cure: do not divide by a length that can be zero; limit the arguments of acos and sqrt to the valid ranges
"""

import numpy as np

from bench.audit.examined import FAULT, Examined, Symptom

ENDLESS = "far from the goal the command is greater than any motor has, and at 180° no number"


def find(examined: Examined) -> Symptom | None:
    """Find answers that are not finite, or a form that is infinite at 180°."""
    if examined.form == "gibbs":
        last = int(np.argmin(np.where(examined.at("near-180"), examined.pairs.distance, np.inf)))
        text = f"its form, 2 tan(θ/2), has no end: |e| = {examined.size[last]:.1g} next to 180°"
        return Symptom(
            text,
            examined.evidence(last, False),
            FAULT,
            ENDLESS,
            "take 2 sin(θ/2) or θ, which have an end",
        )
    answered = np.array([not reason for reason in examined.raised])
    bad = answered & ~np.isfinite(examined.e).all(axis=1)
    places = ", ".join(dict.fromkeys(examined.pairs.place[bad]))
    return examined.first(bad, f"no finite numbers for {bad.sum()} of {len(bad)} pairs ({places})")
