"""the error has a dead band.

effect: the robot stops beside its goal; an integral term, or a force near the edge of the dead band, causes chatter
cure: remove the dead band and any rounding; use a filter against noise
unless: single-precision
"""

import numpy as np

from bench.audit.examined import Examined, PairEvidence, Symptom, inputs
from bench.audit.pairs import at_angles, joined

SMALLEST_RAD = 1e-7
"""A dead band below this is none to a robot; the arc cosine's zero ends at 2e-8, and is a loss of digits."""
FEWEST, SEED = 10, 13


def find_step(examined: Examined) -> float:
    """Return the step of which every component is a multiple; 0 if there is none, or none that a robot sees."""
    components = np.abs(examined.e[examined.at("near-identity", "fine", "close")])
    step = float(np.min(components[components > 0.0], initial=np.inf))
    multiples = components / step
    is_step = SMALLEST_RAD * examined.slope < step < np.inf and np.abs(multiples - np.round(multiples)).max() < 1e-3
    return step if is_step else 0.0


def find_known(examined: Examined) -> Symptom | None:
    """e is exactly zero, or a component of it, up to an angle; beyond it is not. Or it has steps everywhere."""
    drawn = at_angles("line", np.random.default_rng(SEED), np.geomspace(SMALLEST_RAD, 1e-3, 40))
    tried, e = joined(examined.pairs, drawn), np.vstack((examined.e, examined.evaluate(drawn).e))
    small = tried.at("near-identity", "fine", "close", "line") & (tried.angle >= SMALLEST_RAD)
    zero = np.flatnonzero(small & ~e.any(axis=1))
    if len(zero) < FEWEST:
        return None
    i = int(zero[np.argmax(tried.angle[zero])])
    text = f"e = 0 up to {tried.angle[i]:.3g} rad"
    if step := find_step(examined):
        text = f"e is rounded: each component is a multiple of {step:.4g}; {text}"
    now, goal = inputs(examined.takes, tried.chosen(slice(i, i + 1)))
    return Symptom(text, PairEvidence(now[0], goal[0], e[i]))
