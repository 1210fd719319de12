"""The controllers of arms that laws are compared with: energy, closed form, and MuJoCo's and numpy's own torques."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.bits import different_rows
from support.driving import ARM_METRICS, recorder, settings
from support.on_arms import ARMS, GAINS, here, torques

import tasks
from bench.engines.arm_episode import controls
from bench.engines.simulate_arms import run_arm as run
from bench.law.contenders import combinations
from bench.law.contenders.registry import baselines_of_arms, find_contender
from bench.law.control.resolved_acceleration import BY_JOINT
from tasks.kinematics import kinematics

JOINT_PD = "joint-pd@joints+inertia-at-home"
SHORT = settings(horizon_s=0.03)
over_arms = pytest.mark.parametrize("arm", ARMS)


def on(arm):
    """Every baseline."""
    return combinations.baselines(tasks.arm(arm).joints)


@over_arms
def test_baselines_are_found_by_their_names(arm):
    assert [one.regulator.name for one in on(arm)] == list(baselines_of_arms())
    assert [find_contender(one.name) for one in on(arm)] == on(arm)
    plant = kinematics(tasks.arm(arm)).model
    assert controls(find_contender(JOINT_PD), False, 1.0, plant).gives_torque == BY_JOINT


@over_arms
def test_native_rows_are_the_reference_rows_bit_for_bit(arm):
    starts = [tasks.start_set(name, 3, arm=arm)[2] for name in ("reach", "uniform")]
    for one in on(arm):
        for integrator, variation in (("euler", "nominal"), ("rk4", "ideal-motors"), ("euler", "mass-1.30")):
            fast, slow = (
                run(engine, one, "arm-regulation", arm, starts, SHORT, ARM_METRICS, integrator, variation)
                for engine in ("native", "reference")
            )
            assert different_rows(fast, slow) == []


# ------------------------------------------------------------------------------------------ joints


@functools.cache
def lively(arm):
    """Samples of one episode under joint PD from the uniform start, without an early stop."""
    kept: list = []
    start = tasks.start_set("uniform", 5, arm=arm)[4]
    chosen = settings(dt_s=5e-4, horizon_s=1.0, hold_ticks=10**9, torque_limit=math.inf)
    run("reference", find_contender(JOINT_PD), "arm-regulation", arm, [start], chosen, (*ARM_METRICS, recorder(kept)))
    return start, kept, chosen


@over_arms
def test_joint_pd_spends_its_energy_on_its_dampers_alone(arm):
    """V(0) - V(t) is the integral of Kv qdot' M qdot (Takegaki and Arimoto 1981), to the step's first order."""
    start, kept, chosen = lively(arm)
    model, n = kinematics(tasks.arm(arm)), tasks.arm(arm).joints
    M = model.inertia_matrix(tasks.arm(arm).home).diagonal()
    viscous = model.model.dof_damping  # of the Jaco's joints: it takes energy too
    q, qdot = (np.array([getattr(sample, name)[:n] for sample in kept]) for name in ("q", "qdot"))
    away = np.array(start.goal_q) - q
    kinetic = np.array([0.5 * v @ model.inertia_matrix(x) @ v for x, v in zip(q, qdot, strict=True)])
    V = kinetic + 0.5 * chosen.gains.kp * (away**2 @ M)
    spent = np.cumsum((qdot**2) @ (chosen.gains.kv * M + viscous)) * chosen.dt_s
    assert V[-1] < 0.05 * V[0]
    assert (np.diff(V) <= 1e-3 * V[0]).all()
    np.testing.assert_allclose(V[0] - V[1:], spent[1:], rtol=0.0, atol=0.03 * V[0])


# ------------------------------------------------------------------------------------ resolved rate


@over_arms
def test_resolved_rate_is_a_servo_on_the_rates_that_the_inverse_gives(arm):
    """tau = D Kv (qdot_d - qdot) + fg, qdot_d = J^+ v by numpy; seven joints damp unseen motion by Kv/2."""
    goal, place = (0.5, 0.5, -0.5, 0.5), np.array((0.3, 0.2, 0.4))
    [one] = [one for one in on(arm) if one.regulator.name == "resolved-rate"]
    for start in tasks.start_set("tumbling", 6, arm=arm):
        at = here(arm, start.q, start.qdot)
        R_d, R = (Rotation.from_quat(quat, scalar_first=True) for quat in (goal, start.quat_wxyz))
        v = GAINS.kp / GAINS.kv * np.array((*(place - at.chain.p), *(R_d * R.inv()).as_rotvec()))
        inverse = np.linalg.pinv(at.J)
        unseen = (np.eye(at.n) - inverse @ at.J) @ at.chain.qdot
        qddot = GAINS.kv * (inverse @ (v - at.velocity)) - 0.5 * GAINS.kv * unseen
        tau, _ = torques(one, at, goal, place)
        np.testing.assert_allclose(tau, at.D @ qddot + at.fg, rtol=0.0, atol=1e-9 * np.abs(tau).max())
