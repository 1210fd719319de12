"""The free body against (2.6) and (2.7) of the paper: closed forms, finite differences, conservation laws."""

import math

import numpy as np
import pytest
from dm_control.rl.control import PhysicsError
from scipy.spatial.transform import Rotation

import tasks
from tasks.base import IDENTITY, Start

DT = 1e-3


def matrix(observation):
    return observation["R"].reshape(3, 3).T


def tumbling(count=10):
    return tasks.start_set("tumbling", count)


@pytest.mark.parametrize("integrator", ["euler", "implicit", "implicitfast"])
def test_angular_velocity_changes_by_dt_u(integrator):
    for start in tumbling():
        environment = tasks.load("free-body", start, integrator=integrator)
        omega = environment.reset().observation["omega"]
        for u in np.random.default_rng(1).normal(scale=50.0, size=(20, 3)):
            after = environment.step(u).observation["omega"]
            np.testing.assert_allclose(after - omega, DT * u, rtol=0, atol=1e-13)
            omega = after


def test_angular_velocity_changes_by_dt_u_to_third_order_under_rk4():
    """MuJoCo averages body-frame rates over the tick: off by less than dt^3 |omega|^2 |u|, and by
    8 times less at half the step."""
    u = np.array([60.0, -40.0, 20.0])
    for start in tumbling():
        errors = []
        for dt in (2e-3, 1e-3):
            environment = tasks.load("free-body", start, dt=dt, integrator="rk4")
            environment.reset()
            change = environment.step(u).observation["omega"] - np.array(start.omega)
            errors.append(np.linalg.norm(change - dt * u))
            assert errors[-1] < dt**3 * (math.hypot(*start.omega) + 1.0) ** 2 * np.linalg.norm(u)
        assert errors[0] / errors[1] == pytest.approx(8.0, rel=0.1)


@pytest.mark.parametrize("integrator", ["euler", "rk4", "implicit", "implicitfast"])
def test_free_rotation_is_the_matrix_exponential_and_momentum_is_conserved(integrator):
    for start in tumbling():
        environment = tasks.load("free-body", start, integrator=integrator)
        environment.reset()
        for _ in range(500):
            observation = environment.step([0.0, 0.0, 0.0]).observation
        turned = Rotation.from_rotvec(0.5 * np.array(start.omega))
        expected = turned * Rotation.from_quat(start.quat_wxyz, scalar_first=True)
        # 500 products of quaternions, each rounded to about 1e-16 and adding up at worst
        np.testing.assert_allclose(matrix(observation), expected.as_matrix(), rtol=0, atol=5e-13)
        np.testing.assert_allclose(observation["omega"], start.omega, rtol=0, atol=1e-12)


def test_euler_step_turns_with_the_new_velocity():
    """R' = exp(dt [omega']x) R with omega' = omega + dt u, as the module says."""
    for start in tumbling():
        environment = tasks.load("free-body", start)
        environment.reset()
        u = np.array([400.0, -300.0, 200.0])
        observation = environment.step(u).observation
        turned = Rotation.from_rotvec(DT * (np.array(start.omega) + DT * u))
        expected = turned * Rotation.from_quat(start.quat_wxyz, scalar_first=True)
        np.testing.assert_allclose(matrix(observation), expected.as_matrix(), rtol=0, atol=2e-15)


def test_diverged_body_is_not_put_back_by_the_simulator():
    """1e11 rad/s is beyond MuJoCo's own limit of 1e10, at which autoreset would put the body back at rest."""
    environment = tasks.load("free-body", Start("diverged", IDENTITY, omega=(1e11, 0.0, 0.0)))
    assert environment.reset().observation["omega"].tolist() == [1e11, 0.0, 0.0]
    with pytest.raises(PhysicsError, match="mjWARN_BADQVEL"):
        environment.step([0.0, 0.0, 0.0])
    assert environment.physics.omega()[0] == pytest.approx(1e11)


@pytest.mark.parametrize("name", ["half-turn", "poles", "wraps"])
def test_exact_starts_reach_mujoco_unrounded(name):
    for start in tasks.start_set(name):
        if "exact" in start.id:
            environment = tasks.load("free-body", start)
            environment.reset()
            assert environment.physics.quat_wxyz() == start.quat_wxyz
