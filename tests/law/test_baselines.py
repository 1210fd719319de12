"""The controllers of arms that laws are compared with: energy, closed form, and MuJoCo's and numpy's own torques."""

import functools
import math

import numpy as np
import pytest
from support.bits import different_rows
from support.driving import recorder, settings
from support.on_arms import ARMS, GAINS, here, torques

import tasks
from bench.engines.arm_episode import controls
from bench.engines.curve import ARM_NUMBERS, blank_curves
from bench.engines.episode import OUTCOME
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate_arms import run_arm as run
from bench.law.contenders import combinations
from bench.law.contenders.registry import baselines_of_arms, find_contender
from bench.law.control.resolved_acceleration import BY_JOINT
from bench.law.inputs import Gains
from tasks.kinematics import kinematics
from tasks.verdict import SETTLED

METRICS = metrics_of(on_arm=True)
JOINT_PD = "joint-pd@joints+inertia-at-home"
SHORT = settings(horizon_s=0.03)
over_arms = pytest.mark.parametrize("arm", ARMS)


def on(arm):
    """Every baseline."""
    return combinations.baselines(tasks.arm(arm).joints)


def rated(arm):
    """Resolved rate."""
    return next(one for one in on(arm) if one.regulator.name == "resolved-rate")


@over_arms
def test_baselines_are_found_by_their_names(arm):
    assert [one.regulator.name for one in on(arm)] == list(baselines_of_arms())
    assert [find_contender(one.name) for one in on(arm)] == on(arm)
    assert controls(find_contender(JOINT_PD), False, 1.0).gives_torque == BY_JOINT


@over_arms
def test_native_rows_are_the_reference_rows_bit_for_bit(arm):
    starts = [tasks.start_set(name, 3, arm=arm)[2] for name in ("reach", "uniform")]
    for one in on(arm):
        for integrator, variation in (("euler", "nominal"), ("rk4", "nominal"), ("euler", "mass-1.30")):
            fast, slow = (
                run(engine, one, "arm-regulation", arm, starts, SHORT, METRICS, integrator, variation)
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
    run("reference", find_contender(JOINT_PD), "arm-regulation", arm, [start], chosen, (*METRICS, recorder(kept)))
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


@over_arms
def test_joint_pd_brings_every_joint_to_its_goal_from_everywhere(arm):
    """Motors have no limit; joint PD passes singularities of J, which it does not use."""
    starts = tasks.start_set("uniform", 24, arm=arm)
    chosen = settings(horizon_s=20.0, hold_ticks=10**9, torque_limit=math.inf)
    curves = blank_curves(len(starts), 200, 100, ARM_NUMBERS)
    rows = run("native", find_contender(JOINT_PD), "arm-regulation", arm, starts, chosen, METRICS, curves=curves)
    assert (rows[:, OUTCOME] == SETTLED).all()
    first = ARM_NUMBERS.index("q_1")
    for start, samples in zip(starts, curves.samples, strict=True):
        np.testing.assert_allclose(samples[-1, first : first + len(start.q)], start.goal_q, rtol=0.0, atol=1e-6)


# ------------------------------------------------------------------------------------ resolved rate


@over_arms
def test_resolved_rate_is_a_servo_on_the_rates_that_the_inverse_gives(arm):
    """tau = D Kv (qdot_d - qdot) + fg, qdot_d = J^+ v by numpy; seven joints damp unseen motion by Kv/2."""
    goal, place, one = (0.5, 0.5, -0.5, 0.5), np.array((0.3, 0.2, 0.4)), rated(arm)
    for start in tasks.start_set("tumbling", 6, arm=arm):
        at = here(arm, start.q, start.qdot)
        phi = np.array(_logarithm(goal, start.quat_wxyz))
        v = GAINS.kp / GAINS.kv * np.array((*(place - at.chain.p), *phi))
        inverse = np.linalg.pinv(at.J)
        unseen = (np.eye(at.n) - inverse @ at.J) @ at.chain.qdot
        qddot = GAINS.kv * (inverse @ (v - at.xdot)) - 0.5 * GAINS.kv * unseen
        tau, _ = torques(one, at, goal, place)
        np.testing.assert_allclose(tau, at.D @ qddot + at.fg, rtol=0.0, atol=1e-9 * np.abs(tau).max())


def _logarithm(to, of):
    from scipy.spatial.transform import Rotation

    R_d, R = (Rotation.from_quat(quat, scalar_first=True) for quat in (to, of))
    return (R_d * R.inv()).as_rotvec()


@over_arms
@pytest.mark.parametrize("gains", [Gains(100.0, 20.0), Gains(2500.0, 500.0)], ids=["papers", "fast servo"])
def test_a_small_motion_falls_as_its_closed_form(arm, gains):
    """x'' + Kv x' + Kp x = 0: a double pole, or with Kv far above Kp/Kv one pole, exp(-Kp/Kv t) to 1/Kv in time."""
    model, home = kinematics(tasks.arm(arm)), tasks.arm(arm).home
    p, quat = model.pose(home)
    start = model.start("near", home, quat, goal_p=tuple((p + 1e-4).tolist()))
    curves = blank_curves(1, 60, 20, ARM_NUMBERS)
    dt_s = 5e-4
    chosen = settings(dt_s=dt_s, horizon_s=0.6, hold_ticks=10**9, gains=gains, torque_limit=math.inf)
    run("native", rated(arm), "arm-regulation", arm, [start], chosen, METRICS, curves=curves)
    left = curves.samples[0, :, ARM_NUMBERS.index("position_error_m")] / (1e-4 * math.sqrt(3.0))
    t = curves.samples[0, :, 0]
    if gains.kv > 100.0:
        closed, allowed = np.exp(-gains.kp / gains.kv * t), 1.5 / gains.kv * gains.kp / gains.kv
    else:
        w = 0.5 * gains.kv
        closed, allowed = (1.0 + w * t) * np.exp(-w * t), 2.0 * w * dt_s
    np.testing.assert_allclose(left, closed, rtol=0.0, atol=allowed)
