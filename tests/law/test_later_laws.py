"""The later laws: responses from rest, and laws that are others seen from elsewhere; by scipy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation
from support import bodies
from support.bits import EPS
from support.states import directions, of_scipy, vector

from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.inputs import AT_REST, Goal, Tuning

GAINS = Tuning(kp=100.0, kv=20.0)
HOME = ScipyRotation.identity()

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
        return np.array(one.law(of_scipy(R), vector(omega), goal, GAINS)), None
    u, after = one.law(of_scipy(R), vector(omega), goal, GAINS, memory or one.regulator.memory)
    return np.array(u), after


@pytest.mark.parametrize("word", ISOTROPIC)
def test_response_from_rest_is_that_of_one_scalar_equation(word):
    """Its file's equation, as scipy integrates it; the law on scipy's three dimensions beside it."""
    equation = ISOTROPIC[word]

    def scalar(_, state):
        theta, rate = state
        return rate, -GAINS.kp * equation.spring(theta) - GAINS.kv * rate + equation.added(theta, rate, *GAINS[:2])

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
