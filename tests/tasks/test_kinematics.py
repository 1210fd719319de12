"""The judge's kinematics of arms, against a product of matrices, finite differences, scipy and MuJoCo's sensors."""

import itertools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.arm_paths import turned_in_place
from support.states import rotation

import tasks
from tasks.kinematics import kinematics, rotation_vector
from tasks.singular import beside, singularity_near

SEED = 5


@pytest.fixture(params=tasks.arm_names())
def model(request):
    return kinematics(tasks.arm(request.param))


def poses(model, count=20, width=1.0, seed=SEED):
    spread = np.random.default_rng(seed).uniform(-width, width, size=(count, model.arm.joints))
    return np.array(model.arm.home) + spread


def test_jacobian_is_the_derivative_of_the_pose(model):
    """Centred differences over 2e-6 rad: truncation 1e-12, rounding 1e-16/1e-6."""
    h = 1e-6
    for q in poses(model):
        columns = []
        for away in h * np.eye(len(q)):
            (p_after, after), (p_before, before) = model.pose(q + away), model.pose(q - away)
            turned = (rotation(after) * rotation(before).inv()).as_rotvec()
            columns.append(np.concatenate((p_after - p_before, turned)) / (2 * h))
        np.testing.assert_allclose(model.jacobian(q), np.array(columns).T, rtol=0, atol=1e-9)


def test_condition_is_the_ratio_of_singular_values(model):
    for q in poses(model):
        assert model.condition(q) == pytest.approx(np.linalg.cond(model.jacobian(q)), rel=1e-12)


@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-8, 1e-3, 1.0, 3.0, math.pi - 1e-8])
def test_rotation_vector_is_scipys(size):
    generator = np.random.default_rng(SEED)
    for _ in range(20):
        axis = generator.normal(size=3)
        turn = Rotation.from_rotvec(size * axis / np.linalg.norm(axis))
        first = Rotation.random(rng=generator)
        to, of = ((turn * first).as_quat(scalar_first=True), first.as_quat(scalar_first=True))
        for sign in (1.0, -1.0):  # of a quaternion and its opposite the same
            found = rotation_vector(tuple((sign * to).tolist()), tuple(of.tolist()))
            np.testing.assert_allclose(found, turn.as_rotvec(), rtol=0, atol=2e-15)


def test_turn_holds_the_position_and_goes_evenly_about_the_axis(model):
    axis = np.array((2.0, -1.0, 2.0)) / 3.0
    done = 0
    for q in poses(model):
        path = turned_in_place(model, q, tuple(axis.tolist()), 0.5, 10)
        if path is not None:
            done += 1
            p, quat = model.pose(q)
            for i, now in enumerate(path):
                here, orientation = model.pose(now)
                expected = Rotation.from_rotvec(0.05 * i * axis) * rotation(quat)
                assert np.linalg.norm(here - p) < 1.1e-12
                assert (expected.inv() * rotation(orientation)).magnitude() < 2e-12
    assert done >= 10


def test_turn_that_leaves_the_workspace_is_none():
    """A UR5e stretched out cannot turn its tool by a right angle against its reach."""
    model = kinematics(tasks.arm("ur5e"))
    q = (0.3, -1.4, 0.02, -0.4, -0.9, 0.0)
    turns = [
        turned_in_place(model, q, axis, math.pi / 2, 18) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    ]
    assert any(path is None for path in turns)


def test_path_of_seven_joints_takes_the_least_rates():
    """The part of a step along the null vector is of second order in the step: a hundredth at a tenth."""
    model = kinematics(tasks.arm("panda"))
    for q in poses(model, 10, 0.5):
        null = np.linalg.svd(model.jacobian(q))[2][6]
        along = []
        for angle in (1e-2, 1e-3):
            path = turned_in_place(model, q, (0.0, 0.6, 0.8), angle, 1)
            along.append(abs(null @ (path[1] - path[0])))
        assert along[1] < 2e-2 * along[0] + 1e-12


def test_search_finds_poses_that_are_there_and_no_others(model):
    found = 0
    for q, guess in zip(poses(model, 20), poses(model, 20, 1.5, SEED + 1), strict=True):
        p, quat = model.pose(q)
        there = model.find(guess, p, quat)
        if there is not None:
            found += 1
            here, orientation = model.pose(there)
            assert np.linalg.norm(here - p) < 1e-11
            assert (rotation(quat).inv() * rotation(orientation)).magnitude() < 1e-11
    assert found >= 10
    assert model.find(guess, np.array((0.0, 3.0, 0.0)), quat) is None


def test_whole_turns_are_taken_off(model):
    for q in poses(model, 5):
        turned = q + math.tau * np.random.default_rng(SEED).integers(-3, 4, size=len(q))
        back = model.into_range(turned)
        np.testing.assert_allclose(np.sin(back), np.sin(q), atol=1e-13)
        assert model.within_range(back) == model.within_range(model.into_range(q))


def test_rates_turn_the_tool_in_place_and_a_start_in_motion_has_its_angular_velocity(model):
    for q in poses(model):
        rates = model.rates(q, (1.0, -2.0, 0.5))
        np.testing.assert_allclose(model.jacobian(q) @ rates, (0, 0, 0, 1.0, -2.0, 0.5), atol=1e-11)
        start = model.start("moving", q, (1.0, 0.0, 0.0, 0.0), rates)
        np.testing.assert_allclose(start.omega, (1.0, -2.0, 0.5), atol=1e-12)


def test_place_beside_a_singularity_has_the_distance_asked_for(model):
    found = [at for q in poses(model, 12) if (at := singularity_near(model, q))]
    assert len(found) >= 8
    made = 0
    for at, distance in itertools.product(found, (1e-2, 1e-4, 1e-6)):
        place = beside(model, at, distance)
        if place is not None:
            made += 1
            s = np.linalg.svd(model.jacobian(place[0]), compute_uv=False)
            assert s[5] == pytest.approx(distance, rel=2e-6)
            assert math.hypot(*place[1]) == pytest.approx(1.0, abs=1e-14)
    assert made >= 10
