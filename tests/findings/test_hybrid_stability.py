"""Raibert and Craig's hybrid control in its original form and in Fisher and Mujtaba's, to first order."""

import itertools

import mujoco
import numpy as np
import pytest

import tasks
from bench.findings.theory.hybrid_stability import (
    ORIGINAL,
    PROJECTED,
    Pose,
    eigenvalues,
    even,
    growth,
    poses,
    tuned,
    unstable_share,
)
from bench.law.inputs import PAPERS_GAINS
from tasks.arm_model import model_xml

ARMS = [name for name in tasks.arm_names() if tasks.arm(name).joints == 6]
SELECTIONS = [held for held in itertools.product((0, 1), repeat=6) if any(held)]
POSITION = (1, 1, 1, 0, 0, 0)


def drawn(arm: str, count: int = 40) -> list[Pose]:
    return poses(tasks.arm(arm), count, seed=7)


def state_matrix(at: Pose, held, form) -> np.ndarray:
    """d/dt (q, qdot) = A (q, qdot), 12 x 12, written out."""
    S = np.diag(np.array(held, float))
    G = np.linalg.inv(at.J) @ S @ at.J if form == ORIGINAL else np.linalg.pinv(S @ at.J) @ (S @ at.J)
    back = np.linalg.solve(at.D, np.diag(even(at)) @ G)
    return np.block([[np.zeros((6, 6)), np.eye(6)], [-PAPERS_GAINS.kp * back, -PAPERS_GAINS.kv * back]])


@pytest.mark.parametrize("arm", ARMS)
def test_the_projected_form_runs_away_nowhere_with_servos_all_alike(arm):
    for at, held in itertools.product(drawn(arm), SELECTIONS):
        assert growth(eigenvalues(at, held, PROJECTED)) < 0.0


@pytest.mark.parametrize("arm", ARMS)
def test_the_original_form_runs_away_somewhere(arm):
    worst = max(unstable_share(drawn(arm), held, ORIGINAL) for held in SELECTIONS)
    assert worst >= 1 / 40


def test_the_original_form_runs_away_at_every_other_pose_of_a_ur5e_whose_hand_is_held_in_place_and_may_turn():
    assert 0.4 < unstable_share(drawn("ur5e", 200), POSITION, ORIGINAL) < 0.7


def test_tuning_each_joint_helps_the_original_form():
    at = drawn("ur5e", 200)
    assert unstable_share(at, POSITION, ORIGINAL, tuned) < 0.5 * unstable_share(at, POSITION, ORIGINAL, even)


@pytest.mark.parametrize("form", [ORIGINAL, PROJECTED])
@pytest.mark.parametrize("held", [POSITION, (1, 1, 0, 0, 0, 1), (0, 0, 1, 1, 1, 0)], ids=str)
def test_growth_is_the_largest_real_part_of_the_written_out_systems_eigenvalues(form, held):
    """What complies adds eigenvalues 0 in pairs, each with one eigenvector.

    A solver's backward error, some n eps |A|, moves such a pair by its root, times that of how skew the axes of what
    complies and of what is held stand to each other: the condition number of the eigenvectors.
    """
    for at in drawn("ur5e"):
        A = state_matrix(at, held, form)
        skew = np.linalg.cond(np.linalg.eig(A[6:, :6])[1])
        nothing = np.sqrt(len(A) * 2.0**-52 * np.linalg.norm(A) * skew)
        by_hand = np.linalg.eigvals(A).real.max()
        found = growth(eigenvalues(at, held, form))
        assert max(found, 0.0) == pytest.approx(by_hand, rel=1e-6, abs=max(nothing, 1e-6))


def test_an_arm_in_mujoco_runs_away_as_fast_as_predicted():
    """From 1e-6 rad along the fastest mode, over so long that it grows a hundredfold: 1e-4 rad, still linear."""
    arm = tasks.arm("ur5e")
    at = next(one for one in drawn("ur5e") if 1.0 < growth(eigenvalues(one, POSITION, ORIGINAL)) < 20.0)
    rates, modes = np.linalg.eig(state_matrix(at, POSITION, ORIGINAL))
    mode = modes[:, rates.real.argmax()].real
    model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-4))
    data = mujoco.MjData(model)
    data.qpos[:] = at.q + 1e-6 * mode[:6] / np.linalg.norm(mode[:6])
    data.qvel[:] = 1e-6 * mode[6:] / np.linalg.norm(mode[:6])
    G = np.linalg.inv(at.J) @ np.diag(POSITION) @ at.J
    for _ in range(round(np.log(100.0) / growth(eigenvalues(at, POSITION, ORIGINAL)) / 1e-4)):
        mujoco.mj_forward(model, data)
        servo = G @ (PAPERS_GAINS.kp * (data.qpos - at.q) + PAPERS_GAINS.kv * data.qvel)
        data.ctrl[:] = data.qfrc_bias - data.qfrc_passive - even(at) * servo
        mujoco.mj_step(model, data)
    assert np.linalg.norm(data.qpos - at.q) == pytest.approx(1e-4, rel=0.02)
