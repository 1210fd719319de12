"""Goals whose joint angles are known, and the set `reach`, whose path is walked again here with scipy's rotations."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

import tasks
from tasks.clearance import CONDITION, COS_BETA, RANGE
from tasks.kinematics import REACHED, kinematics

ARMS = tasks.arm_names()
on_every_arm = pytest.mark.parametrize("arm", ARMS)
BETWEEN = 1.05  # between the points that the search looked at a condition number can be a little larger


def rotation(quat):
    return Rotation.from_quat(quat, scalar_first=True)


@on_every_arm
@pytest.mark.parametrize("name", tasks.start_set_names(arm=True))
def test_tool_is_at_its_goal_where_the_set_says_which_joint_angles_that_is(arm, name):
    model, knows = kinematics(tasks.arm(arm)), tasks.knows_joints(name)
    for start in tasks.start_set(name, arm=arm):
        assert bool(start.goal_q) == knows
        assert bool(start.goal_p) == (name == "reach")
        if knows:
            p, quat = model.pose(start.goal_q)
            expected = start.goal_p or model.pose(start.q)[0]
            assert np.linalg.norm(p - expected) <= REACHED
            assert (rotation(quat).inv() * rotation(start.goal_wxyz)).magnitude() <= REACHED
            assert model.within_range(start.goal_q)


@on_every_arm
def test_reach_moves_and_turns_and_its_straight_way_is_clear(arm):
    model = kinematics(tasks.arm(arm))
    for start in tasks.start_set("reach", arm=arm):
        p, _ = model.pose(start.q)
        ends = Rotation.concatenate([rotation(start.quat_wxyz), rotation(start.goal_wxyz)])
        assert np.linalg.norm(np.subtract(start.goal_p, p)) >= 0.1
        assert math.radians(10.0) <= (ends[0].inv() * ends[1]).magnitude() <= math.radians(150.0)
        shares = np.linspace(0.0, 1.0, 100)
        turn = Slerp([0.0, 1.0], ends)(shares)
        assert np.hypot(*turn.as_matrix()[:, :2, 0].T).min() >= COS_BETA * 0.99
        now = np.array(start.q)
        for share, quat in zip(shares, turn.as_quat(scalar_first=True).tolist(), strict=True):
            now = model.reach(now, p + share * (np.array(start.goal_p) - p), tuple(quat))
            assert now is not None, start.id
            assert np.linalg.cond(model.jacobian(now)) <= CONDITION * BETWEEN
            assert model.within_range(now, RANGE - 0.02)
        if len(start.q) == 6:  # with seven joints the path ends where its steps lead
            np.testing.assert_allclose(now, start.goal_q, rtol=0.0, atol=1e-10)


def test_agent_sees_where_the_tool_shall_be_if_it_shall_move():
    moved, held = (tasks.start_set(name, 1, arm="ur5e")[0] for name in ("reach", "clear"))
    assert tuple(tasks.load("arm-regulation", moved, arm="ur5e").reset().observation["goal_p"]) == moved.goal_p
    assert "goal_p" not in tasks.load("arm-regulation", held, arm="ur5e").reset().observation
