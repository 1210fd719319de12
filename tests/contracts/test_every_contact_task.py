"""What every task in contact of tasks/domains keeps to, on every arm that has a wrist; a new file needs no change here.

That no trial is refused is in test_compliant_refusals.py.
"""

import functools
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.bits import EPS
from support.buffers import inertia_of, jacobian_of, state_of
from support.in_contact import ARMS

import tasks
from tasks.arm_model import model_xml as arm_xml
from tasks.contact import prepare
from tasks.contact_model import STANDARD, model_xml
from tasks.sensors import SENSORS

DT = 1e-3
# What kinematics of a chain of seven bodies and quaternions of its poses round: some hundred last places.
ROUNDING = 300 * EPS


@pytest.fixture(params=[(word, arm) for word in tasks.contact_names() for arm in ARMS], ids="-on-".join)
def case(request):
    word, arm = request.param
    return made(word, arm)


@functools.cache
def made(word: str, name: str):
    """A task on an arm, its model and data; state is no test's to rely on."""
    task, arm = tasks.contact_task(word), tasks.arm(name)
    model = mujoco.MjModel.from_xml_string(model_xml(task, arm, DT))
    alone = mujoco.MjModel.from_xml_string(arm_xml(arm, DT))
    return SimpleNamespace(
        word=word,
        task=task,
        arm=arm,
        around=task.surroundings(arm),
        trials=task.trials(arm),
        every=tuple(dict.fromkeys((*task.trials(arm), *task.trials(arm, dense=True)))),
        model=model,
        data=mujoco.MjData(model),
        alone=alone,
    )


def begin(case, trial) -> None:
    """The state in which a trial begins."""
    mujoco.mj_resetData(case.model, case.data)
    prepare(case.model, case.data, trial)
    mujoco.mj_forward(case.model, case.data)


def shaken(case, trial, seed: int) -> None:
    """A trial's start with all joints moving, and the scene pushed up in millimetres until it is in the hand."""
    begin(case, trial)
    case.data.qvel[:] = np.random.default_rng(seed).normal(scale=0.01, size=case.model.nv)
    for _ in range(20):
        case.data.mocap_pos[0, 2] += 1e-3
        mujoco.mj_forward(case.model, case.data)
        if case.data.nefc:
            break


def measured(case) -> np.ndarray:
    """F = (f, m), what the sensor in the wrist says the surroundings do to the hand, base frame."""
    R = case.data.site("hand").xmat.reshape(3, 3)
    gauge = case.data.sensordata[19:25]
    return -np.concatenate((R @ gauge[:3], R @ gauge[3:]))


def pushed(case) -> np.ndarray:
    """The push from outside as (f, m) at the hand's site, base frame."""
    body = case.model.body("hand").id
    push = case.data.xfrc_applied[body]
    arm = case.data.xipos[body] - case.data.site("hand").xpos
    return np.concatenate((push[:3], push[3:] + np.cross(arm, push[:3])))


def test_task_says_what_it_is_and_its_trials_are_the_same_at_every_call_with_names_of_their_own(case):
    assert case.task.name == case.word
    assert all((case.task.title, case.task.source))
    for dense in (False, True):
        found = case.task.trials(case.arm, dense=dense)
        assert found == case.task.trials(case.arm, dense=dense)
        assert len({trial.id for trial in found}) == len(found) > 0
    assert found == case.trials or len(found) > len(case.trials)


def test_trials_of_one_pose_differ_in_what_pushes_alone(case):
    by_pose = {}
    for trial in case.trials:
        bare = trial._replace(id="", push=(), legs=())
        assert by_pose.setdefault(trial.pose, bare) == bare


def test_hand_begins_at_its_goal(case):
    for trial in case.every:
        begin(case, trial)
        seen = case.data.sensordata[12:16]  # a quaternion and its negative are the same
        assert abs(1.0 - abs(seen @ trial.goal_wxyz)) <= ROUNDING


def test_hand_has_no_mass_and_its_frame_is_at_its_tip_however_it_is_drawn(case):
    tip, hand = np.array(case.around.tip), case.model.body("hand").id
    assert case.model.body_subtreemass[hand] == 0.0
    assert (case.model.body_inertia[hand] == 0.0).all()
    for trial in case.trials:
        begin(case, trial)
        wrist, site = case.data.site("wrist"), case.data.site("hand")
        assert np.abs(wrist.xmat.reshape(3, 3).T @ (site.xpos - wrist.xpos) - tip).max() <= ROUNDING


def test_dynamics_of_the_arm_are_the_arms_alone(case):
    """The controller's D and fg are exact, and no joint of the scene's is coupled to them but by contact."""
    n = case.arm.joints
    for trial in case.trials[:3]:
        shaken(case, trial, 5)
        data_alone = state_of(case.alone, trial.q, case.data.qvel[:n])
        D, alone = inertia_of(case.model, case.data), inertia_of(case.alone, data_alone)
        assert np.abs(D[:n, :n] - alone).max() <= ROUNDING * np.abs(alone).max()
        assert (D[:n, n:] == 0.0).all()
        for field in ("qfrc_bias", "qfrc_passive"):
            here, there = (getattr(data, field)[:n] for data in (case.data, data_alone))
            assert np.abs(here - there).max() <= ROUNDING * max(1.0, np.abs(there).max())


def test_joints_and_motors_of_the_arm_come_first_and_sensors_where_an_observer_looks_for_them(case):
    n = case.arm.joints
    assert [case.model.joint(i).name for i in range(n)] == [case.alone.joint(i).name for i in range(n)]
    assert case.model.jnt_qposadr[:n].tolist() == case.model.jnt_dofadr[:n].tolist() == list(range(n))
    assert case.model.nu == n
    assert case.model.actuator_trnid[:, 0].tolist() == list(range(n))
    expected = [(name, size) for name, _, size in SENSORS] + [("p", 3), ("force", 3), ("moment", 3)]
    if case.model.npair:
        expected.append(("gap", 1))
    if case.around.joint:
        expected.append(("turned", 1))
    model = case.model
    assert [(model.sensor(i).name, int(model.sensor_dim[i])) for i in range(model.nsensor)] == expected


def test_only_the_hand_and_the_scene_touch(case):
    model = case.model
    assert not model.geom_contype.any()
    assert not model.geom_conaffinity.any()
    for geoms in zip(model.pair_geom1, model.pair_geom2, strict=True):
        bodies = {model.body(model.geom_bodyid[geom]).name for geom in geoms}
        assert "hand" in bodies
        assert len(bodies) == 2


def test_contacts_are_as_the_contact_model_says(case):
    """How stiff and how damped is asked of what presses (test_contact_model)."""
    other = STANDARD._replace(stiffness=1e5, damping=700.0, dmin=0.6, dmax=0.75, width=0.002, friction=0.3, slip=0.05)
    model = mujoco.MjModel.from_xml_string(model_xml(case.task, case.arm, DT, other._replace(impratio=7.0, noslip=3)))
    assert (model.opt.impratio, model.opt.noslip_iterations) == (7.0, 3)
    for solref, solimp in ((model.pair_solref, model.pair_solimp), (model.eq_solref, model.eq_solimp)):
        assert (solref < 0.0).all()
        assert np.allclose(solref[:, 0] / solref[:, 1], 1e5 / 700.0, rtol=1e-15)
        assert (solimp[:, :3] == (0.6, 0.75, 0.002)).all()
    assert (model.pair_friction[:, :2] == 0.3).all()
    assert (model.pair_solreffriction[:, 0] == 0.05).all()


def test_trials_begin_with_nothing_touching_and_every_grip_in_place(case):
    for trial in case.every[:: max(1, len(case.every) // 40)]:
        begin(case, trial)
        assert all(contact.dist >= 0.0 for contact in case.data.contact)
        equalities = case.data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY
        assert np.abs(case.data.efc_pos[equalities]).max(initial=0.0) <= ROUNDING


def test_wrist_sensor_balances_constraints_and_pushes_at_the_joints(case):
    """J^T F = qfrc_constraint + J^T push: MuJoCo's solver on the one side, its sensors on the other."""
    for seed, trial in enumerate(case.trials):
        shaken(case, trial, seed)
        J, F = jacobian_of(case.model, case.data, "hand")[:, : case.arm.joints], measured(case)
        expected = case.data.qfrc_constraint[: case.arm.joints] + J.T @ pushed(case)
        assert np.abs(expected).max() > 1e-3
        assert np.abs(J.T @ F - expected).max() <= ROUNDING * np.linalg.norm(F)


def test_gap_is_the_depth_of_the_deepest_contact(case):
    if not case.model.npair:
        pytest.skip("nothing touches anything here")
    for seed, trial in enumerate(case.trials):
        begin(case, trial)
        assert case.data.sensor("gap").data == 0.0
        shaken(case, trial, seed)
        assert case.data.sensor("gap").data == min(contact.dist for contact in case.data.contact) < 0.0


def test_mount_draws_the_hands_frame_and_moves_nothing(case):
    """Trials alike but for frame and goal are one and the same mechanics."""
    alike = {}
    for trial in case.trials:
        alike.setdefault(trial._replace(id="", pose="", goal_wxyz=(), mount_wxyz=()), []).append(trial)
    assert max(map(len, alike.values())) > 1
    for same in alike.values():
        seen = []
        for trial in same:
            shaken(case, trial, 7)
            turned = Rotation.from_matrix(case.data.site("hand").xmat.reshape(3, 3)).as_quat(scalar_first=True)
            assert abs(1.0 - abs(turned @ trial.goal_wxyz)) <= ROUNDING
            seen.append(np.concatenate((case.data.qacc, measured(case))))
        assert np.ptp(seen, axis=0).max() <= ROUNDING * np.abs(seen).max()
