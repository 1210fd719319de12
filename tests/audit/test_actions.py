"""Conventions that are in use, planted faults, and noise, in simulated logs of a robot that lags and is measured."""

import json
import re
import shlex

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.command_line import bench, refused

from bench.audit.actions.report import audit_actions

EPISODES, STEPS = 6, 115
turn, euler = Rotation.from_rotvec, Rotation.from_euler
TURNED = euler("z", 45, degrees=True)


def simulate(command, seed):
    """Return poses (n x 3 x 3), actions, the next poses and episodes; command(R, last target, w): action, target."""
    rng = np.random.default_rng(seed)
    w = np.cumsum(rng.normal(size=(EPISODES, STEPS + 5, 3)), axis=1)
    w = w[:, 5:] - w[:, :-5]  # the sum of five draws: smooth, and zero on the average
    paths, actions = [], []
    for one in 0.12 * w / np.sqrt((w**2).sum(axis=2).mean()):
        R = T = Rotation.random(rng=rng)
        paths.append([R.as_matrix()])
        for each in one:
            action, T = command(R, T, each)
            R = R * turn(0.8 * (R.inv() * T).as_rotvec())
            paths[-1].append(R.as_matrix())
            actions.append(action)
    noise = turn(5e-4 * rng.normal(size=(EPISODES * (STEPS + 1), 3))).as_matrix()
    poses = np.array(paths) @ noise.reshape(EPISODES, -1, 3, 3)
    now, later = poses[:, :-1].reshape(-1, 3, 3), poses[:, 1:].reshape(-1, 3, 3)
    return now, np.array(actions), later, np.repeat(range(EPISODES), STEPS)


IN_USE = {
    # robosuite@1063bbdd robosuite/controllers/parts/arm/osc.py: compute_goal_ori, scaled from [-1, 1] to 0.5 rad
    "robosuite": (lambda R, T, w: (w / 0.5, turn(w) * R), "rotation-vector base scale=0.5"),
    # robomimic@2e32a25f robomimic/scripts/conversion/robosuite_add_absolute_actions.py: rotation vector of the goal
    "robomimic": (lambda R, T, w: ((turn(w) * R).as_rotvec(), turn(w) * R), "rotation-vector absolute radians"),
    # diffusion_policy@27395b75 diffusion_policy/model/common/rotation_transformer.py: first two rows of the goal
    "diffusion-policy": (lambda R, T, w: ((turn(w) * R).as_matrix()[:2].ravel(), turn(w) * R), "6d-rows absolute"),
    # universal_manipulation_interface@c34ba9c6 umi/common/pose_util.py: rows of R^T R_d
    "umi": (lambda R, T, w: (turn(w).as_matrix()[:2].ravel(), R * turn(w)), "6d-rows body"),
    # droid@ba46d4af droid/misc/transformations.py: add_angles; droid/robot_ik/robot_ik_solver.py: 0.15 rad
    "droid": (lambda R, T, w: (w / 0.15, euler("xyz", w) * R), "euler-xyz base scale=0.15"),
    # calvin_env@2312e993 calvin_env/utils/utils.py: to_relative_action, differences of angles over 0.05 rad
    "calvin": (lambda R, T, w: (w * 20, euler("xyz", R.as_euler("xyz") + w)), "euler-xyz difference scale=0.05"),
    # bridge_data_robot@07d656fa widowx_envs/widowx_envs/base/robot_base_env.py: _next_qpos, from the last target
    "bridge": (lambda R, T, w: (w, euler("xyz", w) * T), "euler-xyz base target radians"),
    # ManiSkill@0a781537 mani_skill/agents/controllers/pd_ee_pose.py: compute_target_pose, aligned with the body
    "maniskill-body": (lambda R, T, w: (w / 0.1, R * euler("XYZ", w)), "euler-XYZ body scale=0.1"),
    # IsaacLab@068603cf source/isaaclab/isaaclab/utils/math.py: apply_delta_pose
    "isaac-lab": (lambda R, T, w: (w, turn(w) * R), "rotation-vector base radians"),
    # IsaacLab@005bd5b2 source/isaaclab/isaaclab/controllers/differential_ik.py: pose, (x, y, z, w)
    "isaac-lab-pose": (lambda R, T, w: ((turn(w) * R).as_quat(), turn(w) * R), "quaternion-xyzw absolute"),
    # lerobot@043e6868 src/lerobot/processor/relative_action_processor.py: to_relative_actions subtracts numbers
    "lerobot": (lambda R, T, w: (w, turn(R.as_rotvec() + w)), "rotation-vector difference radians"),
}


@pytest.mark.parametrize("name", IN_USE)
def test_convention_in_use_is_found_with_the_gain_of_the_robot(name):
    command, words = IN_USE[name]
    report = audit_actions(*simulate(command, 0), expect=words)
    assert report.faults() == {}
    assert not report.found.rivals
    one = report.found.best.convention
    scale = float(words.partition("scale=")[2] or 1.0)
    assert one.gain * one.unit == pytest.approx(scale * (1.0 if one.follows else 0.8), rel=0.02)


def box(R, T, w):
    """Clip a delta of two columns by number, and decode it (inspect-robots#150)."""
    numbers = turn(w).as_matrix()[:, :2].T.ravel()
    a, b = np.clip(numbers, -0.5, 0.5).reshape(2, 3)
    x = np.linalg.qr(np.stack((a, b), axis=1))[0].T
    x *= np.sign((x * (a, b)).sum(axis=1))[:, None]
    return numbers, R * Rotation.from_matrix(np.stack((*x, np.cross(*x)), axis=1))


PLANTED = {
    "quaternion-order": (IN_USE["isaac-lab-pose"][0], "quaternion-wxyz absolute"),
    "side": (IN_USE["isaac-lab"][0], "rotation-vector body"),
    "euler-order": (IN_USE["droid"][0], "euler-zyx base"),
    "degrees": (lambda R, T, w: (np.degrees(w), turn(w) * R), "rotation-vector base radians"),
    "clip": (lambda R, T, w: (w, turn(np.clip(w, -0.07, 0.07)) * R), "rotation-vector base"),
    "clip of columns": (box, "6d-columns body"),
    "inverse": (lambda R, T, w: (-w / 0.1, euler("XYZ", w) * R), "euler-XYZ base scale=0.1"),  # ManiSkill#1435
    "inverse of a goal": (lambda R, T, w: ((turn(w) * R).inv().as_quat(), turn(w) * R), "quaternion-xyzw"),
    "offset": (lambda R, T, w: (TURNED.apply(w), turn(w) * R), "rotation-vector base"),
    "offset of a tool": (lambda R, T, w: ((turn(w) * R * TURNED).as_quat(), turn(w) * R), ""),  # robosuite#615
    "difference": (lambda R, T, w: (w, euler("xyz", R.as_euler("xyz") + w)), ""),  # ManiSkill#1376
}


@pytest.mark.parametrize("name", PLANTED)
def test_planted_fault_is_named_and_no_other(name):
    command, words = PLANTED[name]
    report = audit_actions(*simulate(command, 2), expect=words)
    assert set(report.faults()) == {name.partition(" ")[0]}
    assert report.code == 1
    assert "offset" not in name or "45.0°" in report.faults()["offset"]


def test_lag_and_two_orders_in_one_log_are_named_with_the_rows():
    R, action, R_next, episode = simulate(IN_USE["isaac-lab-pose"][0], 3)
    late = audit_actions(R[:-1], action[1:], R_next[:-1], episode[:-1]).faults()
    early = audit_actions(R[1:], action[:-1], R_next[1:], episode[1:]).faults()
    assert (late, early) == ({"lag": "action t moves pose t+1"}, {"lag": "action t moves pose t-1"})
    action[400:] = action[400:, [3, 0, 1, 2]]
    faults = audit_actions(R, action, R_next, episode).faults()
    assert list(faults) == ["mixed"]
    assert "from 400 to 689 are explained by quaternion-wxyz" in faults["mixed"]


def test_what_small_motions_near_the_identity_cannot_tell_apart_is_said():
    rng = np.random.default_rng(5)
    R, noise = turn(0.007 * rng.normal(size=(300, 3))), turn(5e-4 * rng.normal(size=(300, 3)))
    action = np.vstack(((R[1:] * R[:-1].inv()).as_rotvec(), np.zeros(3)))
    report = audit_actions((R * noise).as_matrix(), action, expect="euler-xyz body")
    assert {"base", "body"} <= {one.relation for one in (report.found.best.convention, *report.found.rivals)}
    assert report.code == 0
    assert "would distinguish them" in report.text()


@pytest.mark.parametrize("name", ["isaac-lab", "isaac-lab-pose", "umi"])
def test_nothing_explains_shuffled_actions_or_noise(name):
    R, action, R_next, episode = simulate(IN_USE[name][0], 1)
    rng = np.random.default_rng(1)
    for unrelated in (rng.permutation(action), rng.normal(size=action.shape)):
        assert audit_actions(R, unrelated, R_next, episode).code == 2


def test_steady_motion_says_nothing_about_actions_that_do_not_change():
    t = np.arange(300.0)[:, None]
    report = audit_actions(turn(t * (0.0, 0.03, 0.05)).as_matrix(), np.tile((0.0, 0.03, 0.05), (300, 1)))
    assert report.code == 2


def test_command_reads_a_table_finds_the_reading_of_its_poses_and_writes_json(tmp_path, capsys):
    pq, pa = pytest.importorskip("pyarrow.parquet"), pytest.importorskip("pyarrow")
    R, action, _, episode = simulate(IN_USE["umi"][0], 6)
    state = np.hstack((np.zeros((len(R), 3)), Rotation.from_matrix(R).as_euler("xyz")))
    columns = {"observation.state": list(state), "action": list(action), "episode_index": episode}
    pq.write_table(pa.table(columns), tmp_path / "log.parquet")
    np.savez(tmp_path / "log.npz", quat=Rotation.from_matrix(R).as_quat(), action=action, episode=episode)
    pose = ["--pose", "observation.state[3:6]"]
    for name, words, reading in (("log.parquet", pose, "euler-xyz"), ("log.npz", [], "quaternion-xyzw")):
        said = bench(capsys, "audit", "actions", tmp_path / name, *words, "--json", tmp_path / "found.json")
        assert (said.code, said.err) == (0, "")
        assert f"6d-rows, body (R' = R A); reading of the poses: {reading}" in said.out
        assert json.loads((tmp_path / "found.json").read_text())["convention"]["pose"] == reading


@pytest.mark.parametrize(
    ("words", "cure"),
    [
        (["nowhere.npz"], "there is no file"),
        (["nowhere.parquet"], "there is no file"),
        (["log.csv"], "save the log with np.savez"),
        (["damaged.npz"], "(File is not a zip file); save arrays of numbers"),
        (["damaged.parquet"], "save arrays of numbers"),
        (["objects.npz"], "(Object arrays cannot be loaded"),
        (["empty.npz"], "'R' has no rows; give a log of at least"),
        (["log.npz", "--pose", "words"], "something else than numbers"),
        (["log.npz", "--action", "acton"], "did you mean 'action'"),
        (["log.npz", "--action", "action[3:7]"], "has 6 numbers; they are counted from 0"),
        (["log.npz", "--action", "action[:2]"], "give 3, 4, 6 or 9 columns"),
        (["log.npz", "--pose", "action[1:3]"], "give its rotation, as --pose NAME[3:6]"),
        (["log.npz", "--action", "action[:3]", "--expect", "axis-angle"], "known: rotation-vector"),
    ],
)
def test_mistake_in_a_log_or_in_words_is_refused_on_one_line_with_the_cure(tmp_path, capsys, words, cure):
    for name in ("damaged.npz", "damaged.parquet", "log.csv"):
        (tmp_path / name).write_text("neither")
    np.savez(tmp_path / "objects.npz", R=np.array([{}]), action=np.zeros((1, 3)))
    np.savez(tmp_path / "empty.npz", R=np.zeros((0, 3, 3)), action=np.zeros((0, 3)))
    np.savez(tmp_path / "log.npz", R=np.tile(np.eye(3), (9, 1, 1)), action=np.zeros((9, 6)), words=np.array(["a"] * 9))
    assert cure in refused(capsys, "audit", "actions", tmp_path / words[0], *words[1:])


def test_examples_of_the_help_are_words_that_the_command_takes(tmp_path, capsys, monkeypatch):
    pq, pa = pytest.importorskip("pyarrow.parquet"), pytest.importorskip("pyarrow")
    monkeypatch.chdir(tmp_path)
    R, action, _, episode = simulate(IN_USE["robosuite"][0], 7)
    np.savez("log.npz", R=R, action=action, episode_index=episode)
    rows = {"observation.state": Rotation.from_matrix(R).as_rotvec(), "action": action}
    wide = {name: list(np.hstack((np.zeros_like(one), one))) for name, one in rows.items()}
    pq.write_table(pa.table({**wide, "episode_index": episode}), "log.parquet")
    lines = re.findall("^   bench (audit actions .*)", bench(capsys, "audit", "actions", "--help").out, re.MULTILINE)
    assert len(lines) == 3
    for line in lines:
        assert bench(capsys, *shlex.split(line)).code == 0
