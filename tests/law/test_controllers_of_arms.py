"""Controllers of arms against MuJoCo's forward dynamics, numpy, energy and closed form: (2.2), (3.7) and the baselines.

With a perfect model an exact inverse gives the tool the acceleration that was commanded (Murphy 1988, 2.3), whatever
the Jacobian, and the analytic Jacobian the torques of the geometric one with (2.15).
"""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.bits import EPS, different_rows
from support.driving import ARM_METRICS, recorder, settings
from support.filling import filled
from support.on_arms import ARMS, GAINS, LAWS, here, named, torques

import tasks
from bench.engines.arm_episode import controls
from bench.engines.simulate_arms import run_arm as run
from bench.law.contenders import combinations
from bench.law.contenders.registry import baselines_of_arms, contenders, find_contender
from bench.law.control.resolved_acceleration import BY_JOINT
from bench.law.weighting import GREATEST_GAIN, LENGTH
from tasks.kinematics import kinematics

over_arms = pytest.mark.parametrize("arm", ARMS)
SEVEN = [arm for arm in ARMS if tasks.arm(arm).joints == 7]

OPERATIONAL = ("operational-pseudo-inverse", "operational-clamped", "operational-damped")
APPROXIMATE = ("damped-least-squares", "transpose", *OPERATIONAL)
EXACT = [word for word in contenders("inverses") if word not in APPROXIMATE]
"""The inverses that give J x = a wherever the damped and the truncated one leave J alone."""

WEIGHTS = np.array([1.0 / LENGTH] * 3 + [1.0] * 4)


@functools.cache
def states(arm: str) -> tuple:
    """(q, qdot, goal, p_d): poses around home, moving, towards goals some 50 degrees and a decimetre away."""
    draw, found = np.random.default_rng(5), []
    model, n = kinematics(tasks.arm(arm)), tasks.arm(arm).joints
    for _ in range(12):
        q, qdot = model.arm.home + draw.uniform(-1.0, 1.0, n), draw.normal(size=n)
        p, quat = model.pose(q)
        turned = Rotation.from_rotvec(0.5 * draw.normal(size=3)) * Rotation.from_quat(quat, scalar_first=True)
        found.append((q, qdot, turned.as_quat(scalar_first=True), p + 0.1 * draw.normal(size=3)))
    return tuple(found)


def singular_values(J, weights=1.0) -> np.ndarray:
    """The six that a rigid body's motion has; a seventh, of four coordinates on seven joints, is zero."""
    return np.linalg.svd(np.broadcast_to(weights, len(J))[:, None] * J, compute_uv=False)[:6]


def is_exact(one, J) -> bool:
    """Whether J is so far from singular that the inverse neither damps nor truncates."""
    return singular_values(J, WEIGHTS[: len(J)])[-1] > 1.0 / GREATEST_GAIN


def on_coordinates(one) -> bool:
    return one.representation is not None and one.jacobian.takes == "coordinates"


def desired(at, p_d, u, gains=GAINS) -> np.ndarray:
    """(2.1) for the position, and the law's own answer."""
    return np.array([*(gains.kp * (p_d - at.chain.p) - gains.kv * at.velocity[:3]), *u])


def rounding(one, at, J) -> float:
    """Relative error of x from J x = a: n^2 EPS times the condition of what is factored (Higham 2002, 10.1, 20.1).

    That is J for a solution by elimination or singular values, J J^T for the others, J D^-1 J^T for Lambda; another
    EPS cond(D) is of MuJoCo's forward dynamics.
    """
    sigma = singular_values(J)
    condition = sigma[0] / sigma[-1]
    of_D = np.linalg.cond(at.D)
    if one.inverse.name not in ("solve", "truncated-svd"):
        condition *= condition
    if one.inverse.gives == "torque":
        condition *= of_D
    return at.n**2 * EPS * (condition + of_D)


@over_arms
def test_perfect_model_gives_the_tool_the_commanded_acceleration(arm):
    tried = set()
    for one in combinations.chosen((), LAWS, tasks.arm(arm).joints):
        if one.inverse.name in APPROXIMATE:
            continue
        for q, qdot, goal, p_d in states(arm)[:2]:
            at = here(arm, q, qdot)
            pair = one.jacobian, one.representation if on_coordinates(one) else None
            J = filled(pair, at.chain)[: one.rows, : at.n]
            if not is_exact(one, J):
                continue
            tried.add(one.inverse.name)
            tau, u = torques(one, at, goal, p_d)
            got = at.acceleration(tau)
            size = np.linalg.norm(at.J, 2) * np.linalg.norm(at.data.qacc) + np.linalg.norm(at.drift)
            if on_coordinates(one):  # B and Bdot of the conversion, each up to 1/margin and 1/margin^2
                size /= one.representation.margin(at.chain.R) ** 2
            np.testing.assert_allclose(
                got, desired(at, p_d, u), rtol=0.0, atol=rounding(one, at, J) * size, err_msg=one.name
            )
    assert tried == set(EXACT) - ({"solve"} if arm in SEVEN else set())


@over_arms
@pytest.mark.parametrize("word", ["pseudo-inverse", "truncated-svd", "dynamically-consistent", "transpose"])
@pytest.mark.parametrize("jacobian", ["geometric", "geometric-body"])
def test_torques_are_the_formula(arm, jacobian, word):
    """tau = D J^+ (a - J z) + D z + fg, a = (u_p, u) - Jdot qdot, z = -Kv/2 qdot on seven joints, else 0.

    With J^T Lambda or J^T in place of D J^+ where the inverse gives torques; J, Jdot, D and fg are MuJoCo's.
    """
    one = named(arm, f"rotation-matrix@{jacobian}+{word}")
    for q, qdot, goal, p_d in states(arm):
        at = here(arm, q, qdot)
        if not is_exact(one, at.J):
            continue
        tau, u = torques(one, at, goal, p_d)
        z = -0.5 * GAINS.kv * qdot if at.n > 6 else np.zeros(at.n)
        a = desired(at, p_d, u) - at.drift - at.J @ z
        if word == "transpose":
            wanted = at.J.T @ a + at.D @ z + at.fg
        elif word == "dynamically-consistent":
            wanted = at.J.T @ np.linalg.solve(at.J @ np.linalg.solve(at.D, at.J.T), a) + at.D @ z + at.fg
        else:
            wanted = at.D @ (np.linalg.pinv(at.J) @ a + z) + at.fg
        atol = rounding(one, at, at.J) * np.linalg.norm(at.D, 2) * np.linalg.norm(np.linalg.pinv(at.J), 2)
        np.testing.assert_allclose(tau, wanted, rtol=0.0, atol=atol * np.linalg.norm(a) + 10 * EPS * np.abs(tau).max())


JOINT_PD = "joint-pd@joints+inertia-at-home"
SHORT = settings(horizon_s=0.03)


def on(arm):
    """Every baseline."""
    return combinations.baselines(tasks.arm(arm).joints)


@over_arms
def test_baselines_are_found_by_their_names(arm):
    assert [one.regulator.name for one in on(arm)] == list(baselines_of_arms())
    assert [find_contender(one.name) for one in on(arm)] == on(arm)
    plant = kinematics(tasks.arm(arm)).model
    assert controls(find_contender(JOINT_PD), False, 1.0, plant).gives_torque == BY_JOINT


@pytest.mark.slow
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


@pytest.mark.slow
@over_arms
def test_joint_pd_spends_its_energy_on_its_dampers_alone(arm):
    """V(0) - V(t) is the integral of Kv qdot' M qdot (Takegaki and Arimoto 1981), to the step's first order."""
    [*_, start], kept = tasks.start_set("uniform", 5, arm=arm), []
    chosen = settings(dt_s=5e-4, horizon_s=1.0, hold_ticks=10**9, torque_limit=math.inf)  # without an early stop
    run("reference", find_contender(JOINT_PD), "arm-regulation", arm, [start], chosen, (*ARM_METRICS, recorder(kept)))
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
