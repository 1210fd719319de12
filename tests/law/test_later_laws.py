"""The later laws: springs, half-circle turns, responses from rest; the side that late-braking keeps, by scipy."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation
from support import bodies
from support.bits import EPS
from support.states import directions, of_scipy, vector

from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.inputs import AT_REST, Gains, Goal

GAINS = Gains(kp=100.0, kv=20.0)

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


def test_weighted_columns_rests_at_three_half_turns_and_no_others():
    for k in np.eye(3):
        u, _ = command("weighted-columns", ScipyRotation.from_matrix(2.0 * np.outer(k, k) - np.eye(3)))
        assert (u == 0.0).all()
    for k in directions(50, 4):
        u, _ = command("weighted-columns", ScipyRotation.from_rotvec(math.pi * k))
        assert np.linalg.norm(u) > 1e-3 * GAINS.kp


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


def linear(times, x, rate):
    """The critically damped response (Murphy 1988, 2.3)."""
    times = times[:, None]
    return (x + (rate + 10.0 * x) * times) * np.exp(-10.0 * times)


PARAMETERS = {"paielli-bach": lambda theta: np.sin(theta / 2.0), "mrp-linearized": lambda theta: np.tan(theta / 4.0)}


@pytest.mark.parametrize("word", PARAMETERS)
def test_parameters_of_a_linearized_law_decay_linearly(word):
    """sin(theta/2) k and tan(theta/4) k of the turn, tumbling at first."""
    times = np.linspace(0.0, 1.0, 41)
    turn, omega = np.array((0.9, -0.7, 0.5)), np.array((1.0, 2.0, -1.5))

    def parameters(R):
        phi = R.as_rotvec()
        theta = np.linalg.norm(phi, axis=-1, keepdims=True)
        return PARAMETERS[word](theta) * phi / np.maximum(theta, 1e-300)

    R, _ = path(word, turn, omega, times)
    h = 1e-6
    ends = parameters(ScipyRotation.from_rotvec([h * omega, -h * omega]) * ScipyRotation.from_rotvec(turn))
    rate = (ends[0] - ends[1]) / (2.0 * h)
    expected = linear(times, parameters(ScipyRotation.from_rotvec(turn)), rate)
    np.testing.assert_allclose(parameters(R), expected, rtol=0.0, atol=1e-7)


def test_sliding_law_slides():
    """z = omega - lambda eps obeys zdot = -K z, K = 10, lambda = 20 at the paper's gains."""
    times = np.linspace(0.0, 0.6, 25)
    R, omega = path("sliding", np.array((1.2, -0.8, 0.4)), np.array((3.0, -1.0, 2.0)), times)
    eps = -R.as_quat()[:, :3] * np.sign(R.as_quat()[:, 3:])  # of the turn to the identity
    z = omega - 20.0 * eps
    np.testing.assert_allclose(z, z[0] * np.exp(-10.0 * times)[:, None], rtol=0.0, atol=1e-7)


def test_laws_with_memory_keep_their_side_beyond_a_half_turn_and_change_it_later():
    """From just short of a half turn: most to eta = -0.4, late-braking to -0.5, mrp-linearized to |sigma|^2 = 1.5."""
    ends = {
        **dict.fromkeys(WITH_SIDE, 2.0 * math.acos(-0.4)),
        "mrp-linearized": 4.0 * math.atan(math.sqrt(1.5)),
        "late-braking": 2.0 * math.acos(-0.5),
    }
    for word, end in ends.items():
        _, memory = command(word, ScipyRotation.from_rotvec((3.1, 0.0, 0.0)))
        for theta, sign in ((math.pi + 0.01, -1.0), (end - 0.01, -1.0), (end + 0.01, 1.0)):
            u, _ = command(word, ScipyRotation.from_rotvec((theta, 0.0, 0.0)), memory=memory)
            assert u[0] * sign > 0.0, (word, theta)


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


NONE_YET = (1.0, 0.0, 0.0, 0.0)
LOOSE = 1e-11 * GAINS.kp
TURNS = [*np.eye(3), *-np.eye(3), (0.6, 0.8, 0.0), (0.0, 0.6, -0.8), (1 / 3, 2 / 3, 2 / 3), (-2 / 3, 1 / 3, 2 / 3)]
"""Axes of every kind: along the base's, within a plane of theirs, and neither."""


def turn(theta, k):
    return ScipyRotation.from_rotvec(theta * np.asarray(k))


def lift(E, near):
    """scipy's quaternion (eta, eps) of E, the one of the two that is nearer to another."""
    q = E.as_quat(scalar_first=True)
    return q if q @ near >= 0.0 else -q


def brake_late(q, omega):
    """Return the command of late-braking on a quaternion (eta, eps) that knows its side."""
    eta, eps = q[0], q[1:]
    pull = GAINS.kp * (1.0 + eta**2) + 0.8 * GAINS.kv * max(0.0, eps @ omega)
    return pull * eps - GAINS.kv * omega


def slide(q, omega):
    """Return the command at K = 10, lambda = 20, the derivative of eps as scipy turns quaternions."""
    eta, eps = q[0], q[1:]
    return -10.0 * (eta * omega + np.cross(eps, omega)) - 10.0 * (omega - 20.0 * eps)


def spring(of_half_angle):
    """Return the command of a spring along the axis, its force over Kp a function of the angle up to 2 pi."""

    def written(q, omega):
        half = math.acos(np.clip(q[0], -1.0, 1.0)) if q[0] < 0.9 else math.asin(np.linalg.norm(q[1:]))
        return GAINS.kp * of_half_angle(half) / math.sin(half) * q[1:] - GAINS.kv * omega

    return written


WITH_SIDE = {
    "hybrid": spring(lambda half: 2.0 * math.sin(half)),
    "rotation-vector-memory": spring(lambda half: 2.0 * half),
    "mrp-memory": spring(lambda half: 4.0 * math.tan(half / 2.0)),
    "sliding-memory": slide,
}
"""Law on the side that `bench.law.side` keeps, to 227 degrees -> its equation, written out."""
ON_A_SIDE = [(word, 227, written) for word, written in WITH_SIDE.items()] + [("late-braking", 240, brake_late)]


@pytest.mark.parametrize(("word", "last", "written"), ON_A_SIDE)
def test_command_is_the_equation_on_the_side_it_is_on_to_its_last_angle_and_on_the_other_beyond(word, last, written):
    for k, omega in zip(TURNS, np.random.default_rng(2).normal(scale=8.0, size=(len(TURNS), 3)), strict=True):
        q, memory = np.array(NONE_YET), NONE_YET
        for theta in np.radians(np.arange(1.0, last, 2.0)):
            q = lift(turn(theta, k), q)
            u, memory = command(word, turn(theta, k).inv(), omega, memory=memory)
            np.testing.assert_allclose(u, written(q, omega), rtol=0.0, atol=LOOSE)
        beyond = turn(np.radians(last + 1.0), k)
        u, memory = command(word, beyond.inv(), omega, memory=memory)
        np.testing.assert_allclose(u, written(-lift(beyond, q), omega), rtol=0.0, atol=LOOSE)


# --------------------------------------------------------------------------- the paper's (Murphy 1988, 2.14-2.15)

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
