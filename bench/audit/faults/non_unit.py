"""the error changes if the input deviates slightly from unit length.

effect: rounding in a sensor or an integrator makes the error wrong or zero
cure: normalize quaternions; limit arguments of acos to [-1, 1], or use atan2
unless: raises, not-a-number, deadband, jump, memory, single-precision
"""

import numpy as np

from bench.audit.examined import NOTE, Examined, PairEvidence, Symptom, evaluate, inputs

OFF = 1e-6
"""What single precision, a sensor or an hour of integration leaves."""
AMPLIFIED = 1e-4
"""Change of e, a hundred times that of the input, in rad times slope."""


def find_known(examined: Examined) -> Symptom | None:
    """Both inputs longer or shorter by a millionth: no number, or another error; a note if it refuses them."""
    places = (examined.at("identity"), examined.at("near-identity", "wide"))
    usable = np.isfinite(examined.e).all(axis=1)
    here = np.concatenate([np.flatnonzero(which & usable)[::step] for which, step in zip(places, (1, 20), strict=True)])
    now, goal = inputs(examined.takes, examined.pairs.chosen(here))
    refused = None
    for scale in (1.0 + OFF, 1.0 - OFF):
        said = evaluate(examined.function, scale * now, scale * goal)
        for i, reason in enumerate(said.raised):
            right = examined.e[here[i]]
            evidence = PairEvidence(scale * now[i], scale * goal[i], reason or said.e[i], right)
            if reason:
                refused = refused or Symptom(
                    f"it refuses input that is off by {OFF:g}", evidence, NOTE
                )
            elif not np.linalg.norm(said.e[i] - right) <= AMPLIFIED * examined.slope:
                return Symptom(f"input that is off by {OFF:g} is answered otherwise", evidence)
    return refused
