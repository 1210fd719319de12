"""The paper's force control: operational space's torques, its power, and rest, where the hand exerts what it shall."""

import numpy as np
import pytest
from support.bits import EPS
from support.in_contact import ARMS, HYBRIDS, SELECTIONS, TOUCH, backward, damping, drawn, hand, tick
from support.states import vector

import tasks
from bench.control.contact_controller import PAPERS_FORM

FRAMES = [one for one in HYBRIDS if one.form == PAPERS_FORM]
CONVERTED = [one for one in FRAMES if one.converts]
UNCONVERTED = [one for one in FRAMES if not one.converts]

over_arms = pytest.mark.parametrize("arm", ARMS)


def named(one) -> str:
    return one.name


def regular(one, at) -> bool:
    return one.representation is None or one.representation.margin(at.chain.R) > 0.2


def ticks(one, arm):
    """(hand, setpoint, held, tick) in the drawn states where its coordinates are regular, selections taking turns."""
    found = 0
    for k, (state, setpoint) in enumerate(drawn(arm)):
        at = hand(*state)
        if regular(one, at):
            found += 1
            for held in SELECTIONS[k::8]:
                yield at, setpoint, held, tick(one, at, setpoint, held)
    assert found >= 3


@over_arms
@pytest.mark.parametrize("one", FRAMES, ids=named)
def test_torques_are_those_of_operational_space(arm, one):
    """tau = J^T (Lambda (S a - (I - S) kc v - Jdot qdot) + (I - S) F_a) + fg, by Lambda = (J D^-1 J^T)^-1.

    On seven joints with their damping where the hand does not see it, D z - J^T Lambda J z.
    """
    for at, _, held, made in ticks(one, arm):
        J, row, S, z = made.J, made.rows, np.diag(held), damping(at.chain.qdot)
        inertia = np.linalg.inv(J @ np.linalg.solve(at.D, J.T))
        motion = S @ row.a - (np.eye(6) - S) @ (TOUCH.kc * row.v) - row.drift - J @ z
        active = (np.eye(6) - S) @ (row.h + TOUCH.kf * (row.h + row.F))
        wanted = J.T @ (inertia @ motion + active) + at.fg + at.D @ z
        size = np.linalg.norm(inertia, 2) * np.linalg.norm(motion) + np.linalg.norm(active)
        allowed = backward(J) * np.linalg.cond(at.D) * np.linalg.norm(J, 2) * size
        np.testing.assert_allclose(made.tau, wanted, rtol=0.0, atol=allowed, err_msg=held)


@over_arms
@pytest.mark.parametrize("one", CONVERTED, ids=named)
def test_what_is_exerted_has_the_power_of_its_wrench_in_every_frame(arm, one):
    """With nothing held (tau - D y - fg) . qdot = w . (pdot, omega): (3.10), by the velocity that MuJoCo's J gives."""
    for at, setpoint, held, made in ticks(one, arm):
        if any(held):
            continue
        h = np.concatenate((setpoint.f_d, setpoint.m_d))
        if one.law == "hybrid-hand":  # exerts along axes that it carries along
            h = np.kron(np.eye(2), at.R @ np.array(setpoint.R_d)) @ h
        w = h + TOUCH.kf * (h + at.F)
        power = (made.tau - at.D @ made.y - at.fg) @ at.chain.qdot
        size = np.linalg.norm(at.D @ made.y) + np.linalg.norm(at.fg) + np.linalg.norm(at.J, 2) * np.linalg.norm(w)
        assert abs(power - w @ at.velocity) <= backward(made.J) * size * np.linalg.norm(at.chain.qdot)


def at_rest(one, arm):
    """(acceleration [m/s^2, rad/s^2] by MuJoCo, the size of what cancels in it) of hands at rest, pushed by F = -h."""
    for (_, q, _, mount, push), setpoint in drawn(arm):
        at = hand(arm, q, np.zeros_like(q), mount, push)
        if not regular(one, at):
            continue
        h = -at.F
        if one.law == "hybrid-hand":
            h = np.kron(np.eye(2), (at.R @ np.array(setpoint.R_d)).T) @ h
        pressing = setpoint._replace(f_d=vector(h[:3]), m_d=vector(h[3:]))
        made = tick(one, at, pressing, SELECTIONS[0])
        joints = np.linalg.norm(np.linalg.inv(at.D), 2) * (np.linalg.norm(at.J.T @ h) + np.linalg.norm(at.fg))
        size = np.linalg.norm(at.J, 2) * joints * np.linalg.cond(made.J)
        yield at.acceleration(made.tau), size * np.linalg.cond(at.D)


@over_arms
@pytest.mark.parametrize("one", CONVERTED, ids=named)
def test_hand_stays_at_rest_in_mujoco_where_it_exerts_what_it_shall(arm, one):
    """F = -h: tau = fg + J^T h, and nothing moves."""
    for acceleration, size in at_rest(one, arm):
        assert np.abs(acceleration).max() <= 200 * EPS * size


@pytest.mark.parametrize("arm", [arm for arm in ARMS if tasks.arm(arm).joints > 6])
@pytest.mark.parametrize("one", FRAMES, ids=named)
def test_no_wrench_and_no_command_turns_the_elbow_of_an_arm_at_rest(arm, one):
    """v^T D qddot = 0 by MuJoCo, J v = 0; by J^+ in its place it would not be."""
    turned = []
    for (_, q, _, mount, push), setpoint in drawn(arm):
        at = hand(arm, q, np.zeros_like(q), mount, push)
        if not regular(one, at):
            continue
        v = np.linalg.svd(at.J)[2][-1]
        for held in SELECTIONS[9::9]:
            made = tick(one, at, setpoint, held)
            at.acceleration(made.tau)
            joints = np.array(at.data.qacc)
            size = np.linalg.norm(at.D, 2) * np.linalg.norm(joints) + np.linalg.norm(at.J.T @ at.F)
            assert abs(v @ at.D @ joints) <= backward(made.J) * np.linalg.cond(at.D) * size, held
            by_least_norm = at.D @ np.linalg.pinv(at.J) @ (at.J @ made.y)
            at.acceleration(made.tau - at.D @ made.y + by_least_norm)
            turned.append(abs(v @ at.D @ at.data.qacc))
    assert np.median(turned) > 0.1


@over_arms
@pytest.mark.parametrize("one", UNCONVERTED, ids=named)
def test_hand_does_not_stay_at_rest_when_moments_are_left_unconverted(arm, one):
    assert min(np.abs(acceleration).max() for acceleration, _ in at_rest(one, arm)) > 1e-2
