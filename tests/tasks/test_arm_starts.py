"""Start sets of arms at poles and 180 degrees, uniform ones, and those whose goal has known joint angles: `reach`."""

import math

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation, Slerp
from support.arm_paths import ARMS, BETWEEN, conditions, cos_beta, evenly, geodesic, in_range, walked
from support.states import rotation

import tasks
from tasks.base import haversine
from tasks.clearance import CONDITION, COS_BETA, RANGE
from tasks.kinematics import REACHED, kinematics

on_every_arm = pytest.mark.parametrize("arm", ARMS)


@on_every_arm
def test_middle_is_on_the_pole_or_misses_it_by_what_the_id_says(arm):
    for start in tasks.start_set("pole", arm=arm):
        middle = geodesic(start, [0.5])
        tilt, n_z = cos_beta(middle)[0], middle.as_matrix()[0, 2, 0]
        assert start.id.startswith("pole-plus" if n_z < 0 else "pole-minus")
        if start.id.endswith("exact"):
            assert tilt < 8e-15  # scipy's middle rounds a few times more
            assert 1.0 - abs(n_z) < 1e-15
        else:
            miss = 10.0 ** -int(start.id[-1])
            assert tilt == pytest.approx(math.sin(miss), abs=1e-14)
            around = geodesic(start, np.linspace(0.4, 0.6, 201))
            assert cos_beta(around).min() == pytest.approx(tilt, abs=1e-14)


@on_every_arm
@pytest.mark.parametrize(("name", "ending"), [("pole", ""), ("half-turn", "k1")])
def test_arm_is_well_conditioned_across_the_pole_and_through_a_half_turn(arm, name, ending):
    """Only 180° starts that are 0.1 rad short count: at exactly 180° either path is possible."""
    for start in tasks.start_set(name, arm=arm):
        if start.id.endswith(ending):
            path = walked(arm, start, geodesic(start, evenly(start)))
            assert conditions(arm, path).max() <= CONDITION * BETWEEN
            assert in_range(arm, path, RANGE - 0.02)


@on_every_arm
def test_half_turn_is_exact_or_short_by_what_the_id_says_about_the_base_axes_and_others(arm):
    axes = {}
    for start in tasks.start_set("half-turn", arm=arm):
        if start.id.endswith("exact"):
            assert haversine(start.quat_wxyz, start.goal_wxyz) >= 1.0 - 1e-15
        else:
            delta = 10.0 ** -int(start.id[-1])
            assert math.pi - tasks.base.angle(start.quat_wxyz, start.goal_wxyz) == pytest.approx(delta, abs=2e-15)
        turn = rotation(start.goal_wxyz) * rotation(start.quat_wxyz).inv()
        axes.setdefault(start.id.split("-")[2], []).append(turn.as_rotvec() / turn.magnitude())
    assert set(axes) == {"x", "y", "z", "drawn0", "drawn1", "drawn2"}
    for i, word in enumerate("xyz"):
        np.testing.assert_allclose(np.abs(axes[word]), np.tile(np.eye(3)[i], (4, 1)), atol=1e-14)


@on_every_arm
def test_uniform_goal_is_reachable_at_the_starts_position(arm):
    """scipy's own least squares, inside the joint ranges or one turn, from drawn joints."""
    one, model = tasks.arm(arm), kinematics(tasks.arm(arm))
    lower, upper = (np.nan_to_num(x, posinf=math.pi, neginf=-math.pi) for x in (one.lower, one.upper))
    generator = np.random.default_rng(17)
    for start in tasks.start_set("uniform", arm=arm)[::40]:
        p, goal = model.pose(start.q)[0], rotation(start.goal_wxyz)

        def miss(q, p=p, goal=goal):
            here, quat = model.pose(q)
            return np.concatenate((here - p, (goal * rotation(quat).inv()).as_rotvec()))

        guesses = [generator.uniform(lower, upper) for _ in range(30)]
        to_rounding = {"bounds": (lower, upper), "ftol": 1e-15, "xtol": 1e-15, "gtol": 1e-15}
        found = (least_squares(miss, guess, **to_rounding).cost < 1e-16 for guess in guesses)
        assert any(found), start.id


@on_every_arm
def test_uniform_joints_and_goals_are_spread_evenly(arm):
    """Thirds of the range hold a third each, and the goals' traces have mean 0; what is refused moves both a little."""
    starts = tasks.start_set("uniform", arm=arm)
    q = np.array([start.q for start in starts])
    one = tasks.arm(arm)
    for joint in range(one.joints):
        low, high = one.lower[joint], one.upper[joint]
        middle, width = (0.5 * (low + high), min(high - low, math.tau)) if high - low < math.inf else (0.0, math.tau)
        share = (abs(q[:, joint] - middle) < width / 6.0).mean()
        assert share == pytest.approx(1.0 / 3.0, abs=0.1)
    assert abs(np.mean([np.trace(rotation(start.goal_wxyz).as_matrix()) for start in starts])) < 0.2


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
