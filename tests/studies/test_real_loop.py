"""The real loop: torques of the exported C++, the theory of late torques, and the committed study."""

import time

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.buffers import bias_of, inertia_of, jacobian_of
from support.states import rotation

import tasks
from bench.experiments import starts
from bench.experiments.tables.store import read
from bench.findings.theory.late_torques import find_greatest_kv
from bench.law.inputs import PAPERS_GAINS
from bench.studies.real_loop.__main__ import LAWS, STARTS, STORED
from bench.studies.real_loop.loop import PERIOD_S, SUBSTEPS, Loop, build_controller

PATIENCE_S = 30.0


def late_by(steps, ticks=2000):
    """Return the tick whose torque is applied at each step, if every torque is as many steps late."""
    return np.maximum(0, (np.arange(ticks * SUBSTEPS) - steps) // SUBSTEPS + 1)


def greatest_modulus(kv, steps):
    """Return the greatest |eigenvalue| of the map of (e, omega, u) over one period."""
    command, h = np.array([-0.25 * kv * kv, -kv, 0.0]), PERIOD_S / SUBSTEPS
    e, omega, u = np.eye(3)
    for step in range(SUBSTEPS):
        omega = omega + h * (u if step < steps else command)
        e = e + h * omega
    return np.abs(np.linalg.eigvals([e, omega, command])).max()


@pytest.mark.parametrize("steps", [0, 2, 4, 7])
def test_limit_of_a_constant_delay_is_that_of_the_eigenvalues(steps):
    found = find_greatest_kv(late_by(steps), SUBSTEPS, PERIOD_S)
    assert greatest_modulus(0.995 * found, steps) < 1.0 < greatest_modulus(1.005 * found, steps)


def test_without_delay_the_limit_is_jurys():
    limit = 4.0 * SUBSTEPS * (np.sqrt(1.0 + 1.0 / SUBSTEPS) - 1.0) / PERIOD_S
    assert find_greatest_kv(late_by(0), SUBSTEPS, PERIOD_S) == pytest.approx(limit, rel=1e-3)


def expected_torque(loop, start):
    """Return D J^+ (a - Jdot qdot) + h by numpy, the law on R by the sine of scipy's rotation vector."""
    model, data, (kp, kv) = loop.model, loop.data, PAPERS_GAINS
    J, drift, D = jacobian_of(model, data, "tool"), bias_of(model, data, "tool"), inertia_of(model, data)
    left = rotation(start.goal_wxyz) * Rotation.from_matrix(data.site("tool").xmat.reshape(3, 3)).inv()
    angle = left.magnitude()
    sine = left.as_rotvec() / angle * np.sin(angle)
    twist = J @ data.qvel
    a = np.r_[-kv * twist[:3], kp * sine - kv * twist[3:]] - drift
    damped = (0.5 * kv if loop.joints > 6 else 0.0) * data.qvel
    return D @ (np.linalg.pinv(J) @ (a + J @ damped) - damped) + data.qfrc_bias - data.qfrc_passive


@pytest.mark.parametrize("arm", ["puma560", "panda"])
def test_controller_answers_with_the_formulas_torque(arm, tmp_path):
    start = starts.on_arm("tumbling", 2, 0, arm)[1]
    with Loop(arm, "nominal", build_controller("rotation-matrix", tmp_path)) as loop:
        loop.begin(start, PAPERS_GAINS)
        loop.tell(1)
        began = time.monotonic()
        while loop.shared["answered"] != 1 and time.monotonic() - began < PATIENCE_S:
            time.sleep(1e-3)
        found = loop.shared["tau"][1, : loop.joints]
        np.testing.assert_allclose(found, expected_torque(loop, start), rtol=1e-8, atol=1e-8)


def test_episode_in_real_time_turns_the_tool_to_its_goal(tmp_path):
    start = starts.on_arm("clear", 1, 0, "ur5e")[0]
    with Loop("ur5e", "ideal-motors", build_controller("late-braking", tmp_path)) as loop:
        course = loop.run(start, PAPERS_GAINS, 1.0)
    assert course.haversine[-1] < 1e-4 * course.haversine[0]
    assert (np.diff(course.answered) >= 0).all()


def test_study_agrees_with_theory_and_the_simulated_loop_on_every_arm():
    rows = read(STORED.parent, "real_loop").astype({"arm": str, "regulator": str})
    assert {*zip(rows["arm"], rows["regulator"], strict=True)} == {
        (arm, law) for arm in tasks.arm_names() for law in LAWS
    }
    np.testing.assert_allclose(rows["kv_predicted"], rows["kv_measured"], rtol=0.1)
    assert (rows["agreeing"] >= STARTS - 1).all()
