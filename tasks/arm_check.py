"""Check on the compiled model what an arm's file must hold.

The last check is the one that matters: at a few poses MuJoCo's own forward dynamics must equal
D^-1 (tau - qfrc_bias + qfrc_passive). Whatever else acts (dry friction, an equality, an actuator with dynamics, gravity
switched off in the file, ...) breaks it, and with it the perfect model that every controller is promised.
"""

from __future__ import annotations

import itertools
import math
import xml.etree.ElementTree as ElementTree
from typing import NoReturn

import mujoco
import numpy as np

from tasks.arm_model import Arm, model_xml
from tasks.errors import BadArm
from tasks.variations import numbers_of

FEWEST, MOST = 6, 7  # fewer joints cannot hold a position and turn freely; the inverses' buffers end at seven

# Solving with D loses log10 of its condition number in digits; from 1e8 on half of a double's sixteen are gone.
MAX_CONDITION = 1e8

# Poses as fractions of the way from the lower to the upper end of each joint; +-pi where it has none.
TRIAL_FRACTIONS = ((0.5, 0.5), (0.2, 0.7), (0.6, 0.3), (0.9, 0.4))

# The two accelerations differ by rounding of the solve, 2e-16 times D's condition number (at most 1e8, above): 1e-6
# of their size leaves a factor of fifty. Dry friction of 1e-3 of the rated torque is a thousand times more.
MODEL_TOLERANCE = 1e-6


def checked(name: str, xml: str) -> Arm:
    """Return the Arm of an MJCF text, or BadArm."""
    model, root = _compiled(name, xml)
    _check_chain(name, model)
    _check_motors(name, model)
    poses = tuple((model.key(i).name, tuple(map(float, model.key_qpos[i]))) for i in range(model.nkey))
    if "home" not in dict(poses):
        _refuse(name, 'it has no keyframe "home"', 'add <keyframe><key name="home" qpos="..."/></keyframe>')
    limited = model.jnt_limited.astype(bool)
    arm = Arm(
        name=name,
        title=_text(name, root, "title"),
        source=_text(name, root, "source"),
        xml=xml,
        home=dict(poses)["home"],
        lower=tuple(map(float, np.where(limited, model.jnt_range[:, 0], -math.inf))),
        upper=tuple(map(float, np.where(limited, model.jnt_range[:, 1], math.inf))),
        rated=tuple(map(float, model.actuator_ctrlrange[:, 1])),
        poses=poses,
        motors=_numbers(name, model, "motors", 3),
        torque_rate=_numbers(name, model, "torque-rate", 1),
        gains=_numbers(name, model, "gains", 2),
    )
    bodies = [model.body(i).name for i in range(model.nbody) if model.body_mass[i] == 0.0]
    if _numbers(name, model, "hand", 7) and "tool" not in bodies:
        _refuse(name, 'it has a hand and no massless body "tool"', "put the site into such a body")
    for i, (low, angle, high) in enumerate(zip(arm.lower, arm.home, arm.upper, strict=True)):
        if not low <= angle <= high:
            joint = model.joint(i).name
            _refuse(name, f"home has joint '{joint}' at {angle:g} rad, outside {low:g} to {high:g}", "move it inside")
    _check_dynamics(arm)
    return arm


def _refuse(name: str, problem: str, cure: str) -> NoReturn:
    raise BadArm(f"arm '{name}': {problem} ({cure})")


def _compiled(name: str, xml: str) -> tuple[mujoco.MjModel, ElementTree.Element]:
    try:
        root = ElementTree.fromstring(xml)
    except ElementTree.ParseError as error:
        _refuse(name, f"it is not XML: {error}", "correct that line")
    if root.find(".//sensor") is not None:
        _refuse(name, "it has sensors of its own, and the judge's must come first", "take its <sensor> out")
    try:
        return mujoco.MjModel.from_xml_string(xml), root
    except ValueError as error:
        _refuse(name, f"MuJoCo refuses it: {' '.join(str(error).split())}", "correct what MuJoCo names")


def _text(name: str, root: ElementTree.Element, key: str) -> str:
    found = root.find(f"./custom/text[@name='{key}']")
    text = "" if found is None else " ".join(found.get("data", "").split())
    if not text:
        _refuse(name, f"it does not say its {key}", f'add <custom><text name="{key}" data="..."/></custom>')
    return text


def _numbers(name: str, model: mujoco.MjModel, key: str, count: int) -> tuple[float, ...]:
    """Return the numbers of a <numeric>, none if it is not there; those of "motors" grow."""
    data = numbers_of(model, key)
    if data is None:
        return ()
    found = tuple(map(float, data))
    if len(found) != count or found[0] <= 0.0 or (key == "motors" and list(found) != sorted(found)):
        _refuse(name, f"its {key} are {found}", f"give {count} numbers, the first above 0; motors in ascending order")
    return found


def _check_chain(name: str, model: mujoco.MjModel) -> None:
    for i in range(model.njnt):
        if model.jnt_type[i] != mujoco.mjtJoint.mjJNT_HINGE:
            kind = mujoco.mjtJoint(model.jnt_type[i]).name.removeprefix("mjJNT_").lower()
            _refuse(name, f"joint '{model.joint(i).name}' is a {kind} joint", "every joint must be a hinge")
    if not FEWEST <= model.nv <= MOST:
        cure = "fewer than 6 cannot hold a position and turn freely" if model.nv < FEWEST else "at most 7 are handled"
        _refuse(name, f"it has {model.nv} joints, not 6 or 7", cure)
    if list(model.dof_parentid) != list(range(-1, model.nv - 1)):
        _refuse(name, "its joints are not one serial chain", "let each joint's body hold the next one's")
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, "tool")
    if site < 0:
        _refuse(name, 'it has no site "tool"', 'add <site name="tool"/> to the last body')
    body = model.site_bodyid[site]
    while body and not model.body_dofnum[body]:
        body = model.body_parentid[body]
    if not body or model.body_dofadr[body] + model.body_dofnum[body] != model.nv:
        _refuse(name, 'its site "tool" does not move with the last joint', "move it to the last body")


def _check_motors(name: str, model: mujoco.MjModel) -> None:
    cure = '<motor joint="..." ctrlrange="-rated rated" ctrllimited="false"/> for each joint, in order'
    if model.nu != model.nv:
        _refuse(name, f"it has {model.nu} motors for {model.nv} joints", f"give {cure}")
    for i in range(model.nu):
        joint = model.joint(i).name
        if model.actuator_trntype[i] != mujoco.mjtTrn.mjTRN_JOINT or model.actuator_trnid[i, 0] != i:
            _refuse(name, f"its motor {i + 1} does not drive joint '{joint}'", f"give {cure}")
        is_plain = (
            model.actuator_gaintype[i] == mujoco.mjtGain.mjGAIN_FIXED
            and model.actuator_biastype[i] == mujoco.mjtBias.mjBIAS_NONE
            and model.actuator_dyntype[i] == mujoco.mjtDyn.mjDYN_NONE
            and model.actuator_gainprm[i, 0] == 1.0
        )
        if not is_plain:
            _refuse(name, f"the actuator of joint '{joint}' is no <motor>: its force is not its ctrl", f"give {cure}")
        if list(model.actuator_gear[i]) != [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]:
            gear = model.actuator_gear[i, 0]
            _refuse(name, f"the motor of joint '{joint}' has gear {gear:g}", "gear 1: ctrl is the joint's torque")
        low, high = map(float, model.actuator_ctrlrange[i])
        if not (math.isfinite(high) and high > 0.0 and low == -high):
            _refuse(name, f"the motor of joint '{joint}' has ctrlrange {low:g} to {high:g}, no rated torque", cure)
        if model.actuator_ctrllimited[i] or model.actuator_forcelimited[i] or model.jnt_actfrclimited[i]:
            _refuse(name, f"the motor of joint '{joint}' is limited: the plant never clips", f"give {cure}")


def _check_dynamics(arm: Arm) -> None:
    model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    if np.any(model.dof_frictionloss > 0.0):
        joint = model.joint(int(np.argmax(model.dof_frictionloss > 0.0))).name
        _refuse(arm.name, f"joint '{joint}' has dry friction", "take frictionloss out: no model of it is perfect")
    data = mujoco.MjData(model)
    D = np.zeros((model.nv, model.nv))
    low = np.where(np.isfinite(arm.lower), arm.lower, -math.pi)
    high = np.where(np.isfinite(arm.upper), arm.upper, math.pi)
    spread = [[pair[i % 2] for i in range(model.nv)] for pair in TRIAL_FRACTIONS]
    for q in (np.array(arm.home), *(low + (high - low) * fractions for fractions in spread)):
        data.qpos[:] = q
        data.qvel[:] = list(itertools.islice(itertools.cycle((0.5, -0.3, 0.2)), model.nv))
        data.ctrl[:] = 0.1 * np.array(arm.rated)
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, D)
        at = "home" if tuple(q) == arm.home else f"q = {np.array2string(q, precision=2, separator=', ')} rad"
        spectrum = np.linalg.eigvalsh(D)
        if not spectrum[0] * MAX_CONDITION > spectrum[-1]:
            _refuse(
                arm.name,
                f"its inertia matrix is singular at {at}: eigenvalues from {spectrum[0]:.1e} to {spectrum[-1]:.1e}",
                "give the last links their inertia, or the joints an armature",
            )
        expected = np.linalg.solve(D, data.ctrl - data.qfrc_bias + data.qfrc_passive)
        if not np.abs(data.qacc - expected).max() <= MODEL_TOLERANCE * np.abs(expected).max():
            _refuse(
                arm.name,
                f"at {at} more acts than inertia, gravity, motors and damping",
                "take out what else acts: equalities, tendons, gravity compensation, disabled flags",
            )
