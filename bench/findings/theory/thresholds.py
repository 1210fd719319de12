"""Closed forms of the thresholds along perturbations, where there is one: near the goal, and at a 180° rotation."""

import functools
import math

import tasks
from bench.base.bisection import bisect
from bench.findings.perturbed import FOLLOWED_RAD
from bench.findings.proofs.certificate import read_certificates
from bench.findings.theory import robustness_theory
from bench.findings.theory.isotropic import EQUATIONS
from bench.law.contenders.registry import all_contenders
from tasks.condition import condition_at

HALF_TURN = "half-turn-noise"

DELTAS = {law: one["delta"] for law, one in read_certificates().items() if one["delta"]}
"""Law -> -eta where it leaves the side that it keeps in memory, eta = cos(theta/2), proved from its source."""

STEPS = 16
"""Halvings of the interval that holds the least noise: to 1e-4 of it on a scale of factors."""

TAIL_HORIZON_S = 5.0
"""Horizon [s] of the episodes under perturbations that last."""


def keeps(law: str) -> float:
    """Return the angle [rad] beyond 180° up to which a law with memory keeps its direction; NaN of other laws."""
    return 2.0 * math.asin(DELTAS.get(law, math.nan))


@functools.cache
def least(law: str, kp: float, kv: float) -> float:
    """Return the least noise [rad] that holds a law at 180°, by its equation or its memory; NaN: neither says."""
    kept = keeps(law)
    if not math.isnan(kept):
        return kept
    has_memory = {one.name for one in all_contenders() if one.regulator.memory}
    # a law without a greatest command has none at a 180° rotation that a tick could hold
    if law not in EQUATIONS or not EQUATIONS[law].is_bounded or law in has_memory:
        return math.nan
    held = functools.partial(robustness_theory.is_held, EQUATIONS[law], kp, kv)
    low, high = math.log(1e-6), math.log(1.0)
    if held(math.exp(low)):
        return 0.0
    return math.exp(bisect(lambda noise: not held(math.exp(noise)), low, high, STEPS)[1])


@functools.cache
def near_goal(axis: str, grows: bool, kp: float, kv: float) -> float:
    """Return the level where the linear loop near the goal is unstable or errs by FOLLOWED_RAD; NaN: no theory."""
    if axis == "delay":
        return robustness_theory.delay_margin(kp, kv)
    if axis == "control-rate":
        return math.nan if grows else robustness_theory.least_rate(kp, kv)
    unit = condition_at(tasks.axis(axis), 1.0)
    if unit.attitude_noise or unit.rate_noise:
        left = robustness_theory.noisy_rms(kp, kv, unit.period_s, unit.attitude_noise, unit.rate_noise)
    elif unit.reference_amplitude:
        left = robustness_theory.tracking_rms(kp, kv, unit.feedforward, unit.period_s, TAIL_HORIZON_S)
    else:
        return math.nan
    return FOLLOWED_RAD / left
