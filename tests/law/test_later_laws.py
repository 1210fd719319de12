"""The later laws: responses from rest, bounds of command and rate, the side of less cost; by scipy."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import solve_continuous_lyapunov
from scipy.spatial.transform import Rotation as ScipyRotation
from support import bodies
from support.bits import EPS
from support.states import directions, of_scipy, vector

from bench.law.contenders.registry import all_contenders, find_contender, regulator
from bench.law.inputs import AT_REST, Gains, Goal, Tuning

GAINS, RIVALS = Gains(kp=100.0, kv=20.0), Gains(kp=37.0, kv=9.0)
HOME = ScipyRotation.identity()
TUNING = Tuning(*GAINS)
"""The gains and no limits, for a law that reads limits."""

ISOTROPIC = {
    one.name: one.equation
    for one in all_contenders()
    if one.equation and one.representation is None and not one.equation.the_long_way
}
"""The equation that each law's file gives for a rotation about one axis from rest, the short way round."""


def command(word, R, omega=AT_REST, R_d=None, memory=None):
    """u of scipy rotations, and the memory after it."""
    one = find_contender(word)
    goal = Goal(of_scipy(R_d or ScipyRotation.identity()))
    if one.regulator.memory is None:
        return np.array(one.law(of_scipy(R), vector(omega), goal, TUNING)), None
    u, after = one.law(of_scipy(R), vector(omega), goal, TUNING, memory or one.regulator.memory)
    return np.array(u), after


@pytest.mark.parametrize("word", ISOTROPIC)
def test_response_from_rest_is_that_of_one_scalar_equation(word):
    """Its file's equation, as scipy integrates it; the law on scipy's three dimensions beside it."""
    equation = ISOTROPIC[word]

    def scalar(_, state):
        theta, rate = state
        return rate, -GAINS.kp * equation.spring(theta) - GAINS.kv * rate + equation.added(theta, rate, *GAINS)

    times = np.linspace(0.0, 1.0, 21)
    for theta, k in zip((0.1, 1.0, 2.0, 3.0), directions(4, 5), strict=True):
        found = path(word, theta * k, AT_REST, times)[0].magnitude()
        expected = solve_ivp(scalar, (0.0, 1.0), (theta, 0.0), "DOP853", times, rtol=1e-11, atol=1e-13).y[0]
        np.testing.assert_allclose(found, abs(expected), rtol=0.0, atol=1e-8)  # beyond the goal theta is negative


def path(word, turn, omega, times):
    """R (a scipy stack) and omega of the closed loop over time, the memory kept as it was at the start."""
    start = ScipyRotation.from_rotvec(turn)
    memory = command(word, start, omega)[1]

    def turned(_, R, omega, __):
        return command(word, R, omega, memory=memory)[0], ()

    return bodies.path(turned, start, omega, times)[:2]


def test_sliding_law_slides():
    """z = omega - lambda eps obeys zdot = -K z, K = 10, lambda = 20 at the paper's gains."""
    times = np.linspace(0.0, 0.6, 25)
    R, omega = path("sliding", np.array((1.2, -0.8, 0.4)), np.array((3.0, -1.0, 2.0)), times)
    eps = -R.as_quat()[:, :3] * np.sign(R.as_quat()[:, 3:])  # of the turn to the identity
    z = omega - 20.0 * eps
    np.testing.assert_allclose(z, z[0] * np.exp(-10.0 * times)[:, None], rtol=0.0, atol=1e-7)


def test_bounded_command_is_the_sine_and_a_damper_bounded_by_kp_at_any_spin():
    """Far above w = Kp/Kv the damper is Kp against the motion, so that |u| <= 2 Kp, which it comes near to."""
    draw = np.random.default_rng(6)
    for R, size, k in zip(
        ScipyRotation.random(400, rng=draw), np.geomspace(1e-3, 1e6, 400), directions(400, 7), strict=True
    ):
        u, phi = command("bounded-command", R, size * k)[0], R.as_rotvec()
        damper = GAINS.kv * size / math.hypot(1.0, size * GAINS.kv / GAINS.kp)
        expected = -GAINS.kp * np.sinc(np.linalg.norm(phi) / math.pi) * phi - damper * k
        np.testing.assert_allclose(u, expected, rtol=0.0, atol=1e-11 * GAINS.kp)
        assert np.linalg.norm(u) <= 2.0 * GAINS.kp * (1.0 + 1e-14)
    worst, _ = command("bounded-command", ScipyRotation.from_rotvec((math.pi / 2.0, 0.0, 0.0)), (1e6, 0.0, 0.0))
    assert np.linalg.norm(worst) == pytest.approx(2.0 * GAINS.kp, rel=1e-6)


def test_predicted_side_is_that_of_less_cost_by_more_than_its_margin():
    """Cost of the straight spring about the axis of the spin: x'Px, P by scipy from Lyapunov's equation."""
    A, feedback = np.array(((0.0, 1.0), (-RIVALS.kp, -RIVALS.kv))), np.array((RIVALS.kp, RIVALS.kv)) / RIVALS.kp
    P = solve_continuous_lyapunov(A.T, -np.diag((1.0, 0.0)) - np.outer(feedback, feedback))
    draw, changes, predicted = np.random.default_rng(4), 0, regulator("predicted-side")
    margin = 4.0 * math.pi * 0.8 * (1.0 / RIVALS.kv + 0.5 * RIVALS.kv / RIVALS.kp)
    for theta, rate, k in zip(
        draw.uniform(0.1, 6.1, 400), draw.normal(scale=20.0, size=400), directions(400, 5), strict=True
    ):
        kept, other = np.array((theta, -rate)), np.array((2.0 * math.pi - theta, rate))
        is_kept = kept @ P @ kept - other @ P @ other <= margin
        side = (math.cos(theta / 2.0), *(math.sin(theta / 2.0) * k))
        u, after = bodies.commanded(
            predicted, ScipyRotation.from_rotvec(-theta * k), rate * k, ScipyRotation.identity(), RIVALS, side
        )
        to_go = theta * k if is_kept else -(2.0 * math.pi - theta) * k
        np.testing.assert_allclose(u, RIVALS.kp * to_go - RIVALS.kv * rate * k, rtol=0.0, atol=1e-9 * RIVALS.kp)
        assert np.dot(after, side) * (1.0 if is_kept else -1.0) > 0.0
        changes += not is_kept
    assert 100 < changes < 300


def test_slew_limited_law_lets_no_rate_grow_beyond_its_limit():
    """At |omega| = Kp/Kv the power is not positive, whatever the orientation."""
    limit = RIVALS.kp / RIVALS.kv
    for R, k in zip(ScipyRotation.random(200, rng=6), directions(200, 5), strict=True):
        u = regulator("slew-limited").law(of_scipy(R), vector(limit * k), Goal(of_scipy(R * R.inv())), RIVALS)
        assert np.dot(u, k) <= 1e-12 * RIVALS.kp


REGULAR = 0.05
"""Margin above which B^-1 is at most 20 times larger than 1."""


def test_laws_as_printed_and_seen_from_the_goal_are_those_whose_equations_casadi_and_pinocchio_have():
    """Hold them to laws that test_counts_against_casadi and test_against_libraries hold to their equations."""
    draw = np.random.default_rng(12)
    # angles move by 10 EPS over the margin, rates by 10 EPS |omega| over its square
    allowed = 40 * EPS * (GAINS.kp / REGULAR + GAINS.kv * 20.0 / REGULAR**2)
    turns, goals = (ScipyRotation.random(300, rng=draw) for _ in range(2))
    for R, R_d, omega in zip(turns, goals, draw.normal(scale=5.0, size=(300, 3)), strict=True):
        if min(np.hypot(*turn.as_matrix()[:2, 0]) for turn in (R, R_d)) < REGULAR:
            continue
        u, literal, linear, printed, goal_at_home = (
            command(f"{word}/zyx-euler", R, omega, aim)[0]
            for word, aim in (
                ("linearized-euler", R_d),
                ("linearized-euler-literal", R_d),
                ("feedback-linearized", R_d),
                ("feedback-linearized-literal", R_d),
                ("linearized-euler", None),
            )
        )
        np.testing.assert_array_equal(literal, u[::-1])
        np.testing.assert_allclose(printed, linear, rtol=0.0, atol=allowed / REGULAR)
        seen, _ = command("linearized-euler-relative/zyx-euler", R_d * R, R_d.apply(omega), R_d)
        np.testing.assert_allclose(seen, R_d.apply(goal_at_home), rtol=0.0, atol=allowed)
