"""Laws with a choice of potential or of side: gradients by differences, points of rest and costs by scipy."""

import math

import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bodies import commanded
from support.states import directions, of_scipy, vector

from bench.law.contenders.registry import regulator
from bench.law.inputs import AT_REST, Gains, Goal

GAINS, HOME = Gains(kp=37.0, kv=9.0), ScipyRotation.identity()
WEIGHTS, KAPPA, GAP = np.array((0.8, 1.0, 1.2)), 0.3, 0.08
AXIS = np.sqrt(1.0 - 2.0 / np.sum(1.0 / WEIGHTS) / WEIGHTS)
"""The body axis for which a_i = k_i (1 - u_i^2) are equal, and u of length 1."""


def potential(X):
    """1/2 tr(K (I - X)) of the orientation X seen from the goal."""
    return 0.5 * WEIGHTS @ (1.0 - np.diag(X.as_matrix()))


def shaped(X, q):
    """Return the potential in force over Kp, with 2.4 for TOP."""
    return 4.8 * (1.0 - math.sqrt(1.0 - potential(warp(X, q)) / 2.4))


def warp(X, q):
    """Turn the body further about its own axis, by q KAPPA times its potential."""
    return X * ScipyRotation.from_rotvec(q * KAPPA * potential(X) * AXIS)


@pytest.mark.parametrize("q", [1.0, -1.0])
def test_synergistic_command_at_rest_is_the_gradient_of_the_potential_in_force(q):
    """Compare with central differences of 1e-5 rad: the third derivative is under 1000, so that they err by 2e-8."""
    draw, h = np.random.default_rng(3), 1e-5
    for X, R_d in zip(ScipyRotation.random(40, rng=draw), ScipyRotation.random(40, rng=draw), strict=True):
        u, after = commanded(regulator("synergistic"), R_d * X, AT_REST, R_d, GAINS, (q, 0.0, 0.0, 0.0))
        ends = [[shaped(X * ScipyRotation.from_rotvec(s * e), after[0]) for s in (h, -h)] for e in np.eye(3)]
        gradient = np.array([(there - back) / (2.0 * h) for there, back in ends])
        np.testing.assert_allclose(u, -GAINS.kp * (R_d * X).apply(gradient), rtol=0.0, atol=1e-7 * GAINS.kp)
        assert (after[0] == q) == (potential(warp(X, q)) - potential(warp(X, -q)) <= GAP)


@pytest.mark.parametrize("q", [1.0, -1.0])
@pytest.mark.parametrize("i", [0, 1, 2])
def test_synergistic_law_changes_potential_where_one_is_at_rest_away_from_the_goal(i, q):
    """Y with warp(Y) the 180° rotation about axis i; the other potential is lower there by more than the gap."""
    half_turn = ScipyRotation.from_rotvec(math.pi * np.eye(3)[i])

    def unwarp(angle):
        return half_turn * ScipyRotation.from_rotvec(-q * angle * AXIS)

    Y = unwarp(brentq(lambda angle: angle - KAPPA * potential(unwarp(angle)), 0.0, 2.2 * KAPPA))
    assert warp(Y, q).approx_equal(half_turn, atol=1e-9)
    assert potential(half_turn) - potential(warp(Y, -q)) > 2.0 * GAP
    u, after = commanded(regulator("synergistic"), Y, AT_REST, HOME, GAINS, (q, 0.0, 0.0, 0.0))
    assert after[0] == -q
    assert np.linalg.norm(u) > 0.1 * GAINS.kp


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


def harden(eta, eps):
    """Return 1/2 ((eta I + [eps]x) Gp + gamma (1 - eta) I) eps, Gp = 4 I, gamma = 8."""
    return 0.5 * (eta * 4.0 * eps + np.cross(eps, 4.0 * eps) + 8.0 * (1.0 - eta) * eps)


def limit(eta, eps):
    """Return 2 eps, shortened to 1."""
    return 2.0 * eps / max(1.0, 2.0 * np.linalg.norm(eps))


@pytest.mark.parametrize(("word", "formula"), [("joshi-kelkar-wen", harden), ("slew-limited", limit)])
def test_error_is_the_formula_on_scipys_quaternion(word, formula):
    for k, R_d in zip(directions(60, 5), ScipyRotation.random(60, rng=7), strict=True):
        for theta in (1e-6, 0.3, 1.0, 1.1, 2.5, math.pi - 1e-6):
            E = ScipyRotation.from_rotvec(theta * k)
            eta, *eps = E.as_quat(canonical=True, scalar_first=True)
            u = regulator(word).law(of_scipy(E.inv() * R_d), AT_REST, Goal(of_scipy(R_d)), GAINS)
            np.testing.assert_allclose(u, GAINS.kp * formula(eta, np.array(eps)), rtol=0.0, atol=1e-13 * GAINS.kp)


def test_slew_limited_law_lets_no_rate_grow_beyond_its_limit():
    """At |omega| = Kp/Kv the power is not positive, whatever the orientation."""
    limit = GAINS.kp / GAINS.kv
    for R, k in zip(ScipyRotation.random(200, rng=6), directions(200, 5), strict=True):
        u = regulator("slew-limited").law(of_scipy(R), vector(limit * k), Goal(of_scipy(R * R.inv())), GAINS)
        assert np.dot(u, k) <= 1e-12 * GAINS.kp
