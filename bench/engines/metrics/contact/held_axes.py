"""Rotation about the axes that the order holds: what a controller lets through of moments about the others."""

import numpy as np

from bench.engines.metrics.contact_force import last
from bench.engines.metrics.contact_metric import ContactMetric, Pose
from bench.engines.metrics.measured_compliance import compliance, complying, held, is_still, turned, turns


def leakage(pose: Pose) -> float:
    """Return the largest ratio |(C e) held| / |(C e) complying| over the axes e that comply; NaN if all do, or none.

    With Z-Y-X angles and compliance about x and y the moment about x leaks tan(beta) into z.
    """
    complies = complying(pose)
    yields = compliance(pose)[:, complies]
    if complies.all() or not complies.any() or is_still(yields).any():
        return np.nan
    leaked, freed = np.linalg.norm(yields[~complies], axis=0), np.linalg.norm(yields[complies], axis=0)
    return float(np.divide(leaked, freed, out=np.full_like(leaked, np.inf), where=freed != 0.0).max())


def held_turn(pose: Pose) -> float:
    """Return the largest rotation [rad] about held axes; NaN if none is held or an episode broke off."""
    about = held(pose)
    if not about.any() or any(one.outcome != "done" for one in pose.responses):
        return np.nan
    return float(max(np.linalg.norm(turn[about]) for turn in turns(pose)))


def loop_drift(pose: Pose) -> float:
    """Rotation [rad] from start to end about axes that the order holds; NaN unless the pushes come in legs.

    To hold omega_z = 0 holds no angle: a square loop of side a about x and y leaves about a^2 about z.
    """
    one = last(pose)
    if one is None or not one.trial.legs:
        return np.nan
    return float(np.linalg.norm(turned(one.R)[held(pose)]))


def loop_rest(pose: Pose) -> float:
    """Angle [rad] of the rotation from start to end; NaN unless the pushes come in legs."""
    one = last(pose)
    return float(np.linalg.norm(turned(one.R))) if one is not None and one.trial.legs else np.nan


METRICS = (
    ContactMetric("leakage_ratio", "1", "rotation about held axes over that about complying ones", leakage),
    ContactMetric("held_turn_rad", "rad", "rotation about held axes at the end", held_turn),
    ContactMetric("loop_drift_rad", "rad", "rotation about held axes left by a closed loop", loop_drift),
    ContactMetric("loop_rest_rad", "rad", "rotation left by a closed loop", loop_rest),
)
