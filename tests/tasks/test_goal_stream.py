"""Goals that arrive as a stream: filters beside scipy's, and the turns that a flipped sign adds."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from tasks.goal_stream import LENGTH_S, PERIOD_S, STREAMS, canonical, continued, goals, rotation_vector, sent, true_goal

DT = 1e-3
COUNT = round(PERIOD_S / DT)
BY_NAME = {one.name: one for one in STREAMS}


def scipy(q):
    return Rotation.from_quat(q, scalar_first=True)


def filled(name):
    return scipy(goals(BY_NAME[name], DT))


def turned(rotations):
    return (rotations[:-1].inv() * rotations[1:]).magnitude()


@pytest.mark.parametrize("name", ["log", "slerp-continued"])
def test_log_and_slerp_by_the_nearer_sign_are_scipys_slerp(name):
    times = np.arange(len(sent())) * PERIOD_S
    at = np.arange(COUNT * (len(times) - 1)) * DT
    expected = Slerp(times, scipy(sent()))(at)
    assert np.max((filled(name).inv() * expected).magnitude()) < 1e-14


def test_rotation_vectors_are_scipys_up_to_180_degrees():
    np.testing.assert_allclose(rotation_vector(canonical(sent())), scipy(sent()).as_rotvec(), atol=1e-14)


def test_true_goal_passes_180_degrees_once():
    w = continued(np.array([true_goal(t) for t in np.arange(0.0, LENGTH_S, DT)]))[:, 0]
    assert np.count_nonzero(np.diff(np.sign(w))) == 1


@pytest.mark.parametrize("name", BY_NAME)
def test_every_stream_meets_the_goals_that_were_sent(name):
    found = filled(name)[::COUNT]
    assert np.max((found.inv() * scipy(sent()[:-1])).magnitude()) < 1e-14


@pytest.mark.parametrize("name", ["rotation-vector", "quaternion", "slerp"])
def test_flip_adds_nearly_a_whole_turn(name):
    extra = turned(filled(name)).sum() - turned(filled("log")).sum()
    step = turned(scipy(sent())).max()
    assert 2.0 * math.pi - 3.0 * step < extra < 2.0 * math.pi


@pytest.mark.parametrize("name", ["rotation-vector-continued", "quaternion-continued", "slerp-continued"])
def test_continued_coordinates_add_nothing(name):
    assert turned(filled(name)).sum() == pytest.approx(turned(filled("log")).sum(), rel=1e-3)
