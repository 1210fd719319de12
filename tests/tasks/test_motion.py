"""Goals that sway or arrive as a stream, and plants commanded by velocities, against scipy."""

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation, Slerp
from support.states import rotation

from tasks.goal_stream import LENGTH_S, PERIOD_S, STREAMS, canonical, continued, goals, rotation_vector, sent, true_goal
from tasks.moving_goal import reference_column, reference_rates
from tasks.velocity import followed, servo, turned

SWAYS = (0.5, 2.0, 10.0)
TIMES = np.linspace(0.0, 5.0, 41)


def goal(time, sway):
    """R_d by scipy, from a first orientation that is not the identity."""
    c = sway * math.sqrt(0.5)
    p, q = c * math.sin(2.0 * time) / 2.0, c * math.sin(3.1 * time) / 3.1
    return Rotation.from_rotvec([0.0, 0.0, p]) * Rotation.from_rotvec([q, 0.0, 0.0]) * FIRST


FIRST = Rotation.from_euler("ZYX", [0.3, -0.4, 0.9])


@pytest.mark.parametrize("sway", SWAYS)
def test_swaying_goal_is_two_turns_with_their_rate_and_acceleration_and_the_peak_that_it_is_named_by(sway):
    h, speeds = 1e-5, []
    for time in TIMES:
        ours = np.column_stack([reference_column(time, sway, tuple(column)) for column in FIRST.as_matrix().T])
        np.testing.assert_allclose(ours, goal(time, sway).as_matrix(), atol=1e-14)
        omega, alpha = reference_rates(time, sway)
        between = goal(time + h, sway) * goal(time - h, sway).inv()
        np.testing.assert_allclose(omega, between.as_rotvec() / (2.0 * h), atol=1e-8 * sway**3)
        after, before = (np.array(reference_rates(time + s, sway)[0]) for s in (h, -h))
        np.testing.assert_allclose(alpha, (after - before) / (2.0 * h), atol=1e-8 * sway**3)
        speeds.append(np.linalg.norm(omega))
    assert max(speeds) == pytest.approx(speeds[0], rel=1e-15) == pytest.approx(sway, rel=1e-15)


@pytest.mark.parametrize("angle", [1e-12, 1e-9, 1e-8, 1e-3, 1.0, 3.1, 7.0])
def test_turned_quaternion_is_scipys(angle):
    rng = np.random.default_rng(3)
    for _ in range(20):
        quat, axis = Rotation.random(rng=rng), rng.normal(size=3)
        turn = angle * axis / np.linalg.norm(axis)
        found = turned(tuple(quat.as_quat(scalar_first=True)), tuple(turn))
        expected = (Rotation.from_rotvec(turn) * quat).as_matrix()
        np.testing.assert_allclose(rotation(found).as_matrix(), expected, atol=2e-15)
        assert np.linalg.norm(found) == pytest.approx(1.0, abs=3e-16)


def test_no_turn_keeps_every_bit():
    quat = (0.0, 0.6, 0.0, 0.8)
    assert turned(quat, (0.0, 0.0, 0.0)) is quat


@pytest.mark.parametrize("lag", [1e-4, 1e-3, 0.05, 2.0])
def test_servo_with_lag_is_the_exponential_of_its_matrix(lag):
    dt, command, rate = 0.01, 0.7, -0.4
    matrix = np.array([[0.0, 1.0, 0.0], [0.0, -1.0 / lag, 1.0 / lag], [0.0, 0.0, 0.0]])  # of (angle, rate, command)
    expected = expm(dt * matrix) @ (0.0, rate, command)
    np.testing.assert_allclose(followed(rate, command, servo(dt, lag)), expected[:2], rtol=1e-12, atol=1e-15)


def test_servo_without_lag_follows_at_once():
    assert followed(-0.4, 0.7, servo(0.01, 0.0)) == (pytest.approx(0.007), 0.7)


DT = 1e-3
COUNT = round(PERIOD_S / DT)
BY_NAME = {one.name: one for one in STREAMS}


def filled(name):
    return rotation(goals(BY_NAME[name], DT))


def steps_of(rotations):
    return (rotations[:-1].inv() * rotations[1:]).magnitude()


@pytest.mark.parametrize("name", ["log", "slerp-continued"])
def test_log_and_slerp_by_the_nearer_sign_are_scipys_slerp(name):
    times = np.arange(len(sent())) * PERIOD_S
    at = np.arange(COUNT * (len(times) - 1)) * DT
    expected = Slerp(times, rotation(sent()))(at)
    assert np.max((filled(name).inv() * expected).magnitude()) < 1e-14


def test_rotation_vectors_are_scipys_up_to_180_degrees():
    np.testing.assert_allclose(rotation_vector(canonical(sent())), rotation(sent()).as_rotvec(), atol=1e-14)


def test_true_goal_passes_180_degrees_once():
    w = continued(np.array([true_goal(t) for t in np.arange(0.0, LENGTH_S, DT)]))[:, 0]
    assert np.count_nonzero(np.diff(np.sign(w))) == 1


@pytest.mark.parametrize("name", BY_NAME)
def test_every_stream_meets_the_goals_that_were_sent(name):
    found = filled(name)[::COUNT]
    assert np.max((found.inv() * rotation(sent()[:-1])).magnitude()) < 1e-14


@pytest.mark.parametrize("name", ["rotation-vector", "quaternion", "slerp"])
def test_flip_adds_nearly_a_whole_turn(name):
    extra = steps_of(filled(name)).sum() - steps_of(filled("log")).sum()
    step = steps_of(rotation(sent())).max()
    assert 2.0 * math.pi - 3.0 * step < extra < 2.0 * math.pi


@pytest.mark.parametrize("name", ["rotation-vector-continued", "quaternion-continued", "slerp-continued"])
def test_continued_coordinates_add_nothing(name):
    assert steps_of(filled(name)).sum() == pytest.approx(steps_of(filled("log")).sum(), rel=1e-3)
