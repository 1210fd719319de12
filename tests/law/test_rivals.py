"""Laws with a choice of side, and a limited rate: costs by scipy."""

import math

import numpy as np
from scipy.linalg import solve_continuous_lyapunov
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bodies import commanded
from support.states import directions, of_scipy, vector

from bench.law.contenders.registry import regulator
from bench.law.inputs import Gains, Goal

GAINS, HOME = Gains(kp=37.0, kv=9.0), ScipyRotation.identity()


def test_predicted_side_is_that_of_less_cost_by_more_than_its_margin():
    """Cost of the straight spring about the axis of the spin: x'Px, P by scipy from Lyapunov's equation."""
    A, feedback = np.array(((0.0, 1.0), (-GAINS.kp, -GAINS.kv))), np.array((GAINS.kp, GAINS.kv)) / GAINS.kp
    P = solve_continuous_lyapunov(A.T, -np.diag((1.0, 0.0)) - np.outer(feedback, feedback))
    draw, changes, predicted = np.random.default_rng(4), 0, regulator("predicted-side")
    margin = 4.0 * math.pi * 0.8 * (1.0 / GAINS.kv + 0.5 * GAINS.kv / GAINS.kp)
    for theta, rate, k in zip(
        draw.uniform(0.1, 6.1, 400), draw.normal(scale=20.0, size=400), directions(400, 5), strict=True
    ):
        kept, other = np.array((theta, -rate)), np.array((2.0 * math.pi - theta, rate))
        is_kept = kept @ P @ kept - other @ P @ other <= margin
        side = (math.cos(theta / 2.0), *(math.sin(theta / 2.0) * k))
        u, after = commanded(predicted, ScipyRotation.from_rotvec(-theta * k), rate * k, HOME, GAINS, side)
        to_go = theta * k if is_kept else -(2.0 * math.pi - theta) * k
        np.testing.assert_allclose(u, GAINS.kp * to_go - GAINS.kv * rate * k, rtol=0.0, atol=1e-9 * GAINS.kp)
        assert np.dot(after, side) * (1.0 if is_kept else -1.0) > 0.0
        changes += not is_kept
    assert 100 < changes < 300


def test_slew_limited_law_lets_no_rate_grow_beyond_its_limit():
    """At |omega| = Kp/Kv the power is not positive, whatever the orientation."""
    limit = GAINS.kp / GAINS.kv
    for R, k in zip(ScipyRotation.random(200, rng=6), directions(200, 5), strict=True):
        u = regulator("slew-limited").law(of_scipy(R), vector(limit * k), Goal(of_scipy(R * R.inv())), GAINS)
        assert np.dot(u, k) <= 1e-12 * GAINS.kp
