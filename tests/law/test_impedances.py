"""What each impedance is, by scipy's rotations and closed forms."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.in_contact import GAINS, TOUCH
from support.springs import STILL, B_at, command, margin, of, seen
from support.states import of_scipy

HALF_TURN = np.pi
SPRING_OF = {
    "geometric": np.sin,
    "quaternion": lambda theta: 2.0 * np.sin(theta / 2.0),
    "rotation-vector": lambda theta: theta,
}
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
