"""What each impedance is, by scipy's rotations and closed forms; how a hand under it comes to rest."""

import numpy as np
import pytest
from scipy.integrate import simpson
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.in_contact import GAINS, TOUCH
from support.springs import STILL, B_at, command, free_body, margin, of, seen
from support.states import of_scipy

from bench.law.control.impedance import law_of

HALF_TURN = np.pi
SPRING_OF = {
    "geometric": np.sin,
    "quaternion": lambda theta: 2.0 * np.sin(theta / 2.0),
    "rotation-vector": lambda theta: theta,
}
ENERGY_OF = {
    "geometric": lambda theta: 1.0 - np.cos(theta),
    "quaternion": lambda theta: 4.0 - 4.0 * np.cos(theta / 2.0),
    "rotation-vector": lambda theta: theta**2 / 2.0,
}
"""Integrals of them: the energy of the spring over kp m_o."""

in_words = pytest.mark.parametrize("word", SPRING_OF)
IN_COORDINATES = [
    f"{law}/{coordinates}"
    for law in ("coordinates", "coordinates-relative")
    for coordinates in ("zyx-euler", "xyz-euler", "rotation-vector", "mrp")
]


@pytest.fixture
def draw():
    return np.random.default_rng(51)


def turned(draw):
    """(angle, axis, R, R_d): turned from the goal by every angle up to the half turn, about an axis of the base."""
    for theta in (1e-12, 1e-6, 1e-3, 0.1, 1.0, 2.0, 3.0, HALF_TURN - 1e-6):
        goal, axis = ScipyRotation.random(rng=draw), draw.normal(size=3)
        axis /= np.linalg.norm(axis)
        yield theta, axis, ScipyRotation.from_rotvec(theta * axis) * goal, goal


@in_words
def test_spring_pulls_back_along_the_axis_by_its_function_of_the_angle(word, draw):
    for theta, axis, turn, goal in turned(draw):
        u = command(of(word), turn, STILL, STILL, goal)
        # the rotations given are orthonormal to some EPS, and the axis of a turn near pi is known to as much
        np.testing.assert_allclose(u, -GAINS.kp * SPRING_OF[word](theta) * axis, rtol=0.0, atol=40 * EPS * GAINS.kp)


@in_words
def test_moment_acts_by_the_apparent_inertia_and_the_rate_is_damped(word, draw):
    for _, _, turn, goal in turned(draw):
        omega, m = draw.normal(size=(2, 3))
        u = command(of(word), turn, omega, m, goal) - command(of(word), turn, STILL, STILL, goal)
        np.testing.assert_allclose(u, m / TOUCH.m_o - GAINS.kv * omega, rtol=0.0, atol=40 * EPS * GAINS.kp)


def test_half_turn_leaves_the_geometric_spring_nothing_and_the_others_all_they_have(draw):
    for axis in (*np.eye(3), *draw.normal(size=(5, 3))):
        turn = ScipyRotation.from_rotvec(HALF_TURN * axis / np.linalg.norm(axis))
        for word, spring in SPRING_OF.items():
            u = command(of(word), turn, STILL, STILL, ScipyRotation.identity())
            assert abs(np.linalg.norm(u) - GAINS.kp * spring(HALF_TURN)) <= 40 * EPS * GAINS.kp
            np.testing.assert_allclose(
                np.cross(u, axis), 0.0, rtol=0.0, atol=40 * EPS * GAINS.kp * np.linalg.norm(axis)
            )


@pytest.mark.parametrize("word", ["quaternion", "rotation-vector"])
def test_spring_turns_the_short_way_round_and_jumps_at_the_half_turn(word):
    before, after = (
        command(of(word), ScipyRotation.from_rotvec((0.0, 0.0, angle)), STILL, STILL, ScipyRotation.identity())[2]
        for angle in (HALF_TURN - 1e-3, HALF_TURN + 1e-3)
    )
    assert before < 0.0 < after
    np.testing.assert_allclose(after, -before, rtol=1e-12)


# ---------------------------------------------------------------------------- in coordinates


@pytest.mark.parametrize("word", IN_COORDINATES)
def test_hand_rests_where_the_springs_of_the_coordinates_balance_the_generalized_moment(word, draw):
    """At any E, however far from E_d, the moment m_o kp B^-T (E - E_d) keeps it there."""
    one, compared = of(word), 0
    while compared < 20:
        turn, goal = ScipyRotation.random(2, rng=draw)
        if min(margin(one, turn, goal), margin(one, goal, goal)) < 0.2:
            continue
        compared += 1
        E, E_d = (np.array(one.representation.chart(of_scipy(seen(one, R, goal))).E) for R in (turn, goal))
        m = GAINS.kp * TOUCH.m_o * np.linalg.solve(B_at(one, turn, goal).T, E - E_d)
        u = command(one, turn, STILL, m, goal)
        np.testing.assert_allclose(u, 0.0, rtol=0.0, atol=500 * EPS * GAINS.kp * np.linalg.norm(E - E_d) / 0.2)


def test_command_is_not_finite_on_the_pole_of_the_coordinates():
    pole = ScipyRotation.from_quat((0.5**0.5, 0.0, 0.5**0.5, 0.0), scalar_first=True)
    u = command(of("coordinates/zyx-euler"), pole, np.ones(3), STILL, ScipyRotation.identity())
    assert margin(of("coordinates/zyx-euler"), pole, pole) == 0.0
    assert not np.isfinite(u).all()


# ---------------------------------------------------------------------------- in free space


@in_words
def test_energy_only_goes_and_goes_by_what_the_damping_takes(word, draw):
    """d/dt (omega^2/2 + kp U(theta)) = -kv omega^2, from far away and spinning."""
    turn, goal = ScipyRotation.random(2, rng=draw)
    omega = 4.0 * draw.normal(size=3)
    times, R, spin, _ = free_body(law_of(of(word).impedance, None), turn, omega, goal, 2.0, count=401)
    theta = (ScipyRotation.from_matrix(R) * goal.inv()).magnitude()
    energy = 0.5 * (spin**2).sum(axis=1) + GAINS.kp * ENERGY_OF[word](theta)
    check_energy(times, energy, GAINS.kv * (spin**2).sum(axis=1))


def check_energy(times, energy, taken):
    """It never grows, goes by what was taken, and in the end is almost none."""
    assert (np.diff(energy) <= 1e-8 * energy[0]).all()
    # Simpson's error is of order h^4 (10/s)^4/180, 1e-7 or less
    assert energy[0] - energy[-1] == pytest.approx(simpson(taken, x=times), rel=1e-6)
    assert energy[-1] < 1e-6 * energy[0]
