"""An arm's hand in one state, pushed by a wrench, as its controller sees it there, and the controller called on it.

J, Jdot, D, fg and the wrench are MuJoCo's own; so is the acceleration that torques give the hand.
"""

import functools
import itertools
from typing import NamedTuple

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation as ScipyRotation

import tasks
from bench.engines.contact_episode import room, rows, wrench
from bench.law.contenders.registry import contenders
from bench.law.control.contact_controller import FORMS
from bench.law.control.hybrid import comply
from bench.law.control.registry import all_controllers
from bench.law.control.setpoint import ContactParameters, Rows, Setpoint
from bench.law.inputs import Gains
from support.bits import EPS
from support.on_arms import GAINS, Here, at_site
from support.states import as_rotation, vector
from tasks.contact import Specification, Trial, can_do, prepare
from tasks.contact_model import model_xml
from tasks.domains.wrench_probe import TASK

ARMS = [arm for arm in tasks.arm_names() if can_do(TASK, tasks.arm(arm))]
HYBRIDS = [one for one in all_controllers() if one.impedance is None]
IMPEDANCES = [one for one in all_controllers() if one.impedance is not None]
COORDINATES = {word: one for word, one in contenders("representations").items() if one.about is not None}
"""Representations with a coordinate for each of the axes x, y and z."""

# Not the defaults, as GAINS: what has those built in is found out.
TOUCH = ContactParameters(m_p=7.0, m_o=0.3, kc=4.0, kf=0.8)
SELECTIONS = [tuple(map(float, held)) for held in itertools.product((0, 1), repeat=6)]
"""All of them; the first holds nothing, the last everything."""


def backward(J) -> float:
    """Relative error of what is solved with J or with normal equations of its rows (test_linalg, test_inverses)."""
    return 6**3 * EPS * np.linalg.cond(J) ** 2


def damping(qdot) -> np.ndarray:
    """z, n: of the joints where they are more than a hand's freedoms, 1/s of half of kv; none on six."""
    return -GAINS.kv / 2.0 * qdot if len(qdot) > 6 else np.zeros(6)


class Tick(NamedTuple):
    """What a controller made of a state: the torques, J in its frame, its rows, and y: tau = D y + fg + J^T w."""

    tau: np.ndarray
    J: np.ndarray
    rows: Rows
    y: np.ndarray


@functools.cache
def simulated(arm: str):
    """One model and its data for all states of an arm."""
    model = mujoco.MjModel.from_xml_string(model_xml(TASK, tasks.arm(arm), 1e-3))
    return model, mujoco.MjData(model)


def hand(arm: str, q, qdot, mount: ScipyRotation, push) -> Here:
    """Return the state with the hand's frame rotated by `mount`; it is valid until the next call."""
    model, data = simulated(arm)
    mujoco.mj_resetData(model, data)
    anyhow = Specification("none", (1,) * 6)
    frame = (1.0, 0.0, 0.0, 0.0), tuple(mount.as_quat(scalar_first=True))
    prepare(model, data, Trial("", "", anyhow, tuple(q), *frame, push=tuple(push)))
    data.qvel[:] = qdot
    return at_site(model, data, "hand", push)


@functools.cache
def drawn(arm: str, count: int = 8, turn: float = 0.5) -> tuple:
    """(arguments of `hand`, setpoint) in states around home, moving and pushed; goals some `turn` rad away."""
    draw, home, found = np.random.default_rng(21), np.array(tasks.arm(arm).home), []
    n = len(home)
    while len(found) < count:
        q, qdot = home + draw.uniform(-0.7, 0.7, n), draw.normal(scale=0.5, size=n)
        at = hand(arm, q, qdot, ScipyRotation.random(rng=draw), np.zeros(6))
        if np.linalg.svd(at.J, compute_uv=False)[-1] < 0.05:
            continue
        mount = ScipyRotation.random(rng=draw)
        push = draw.normal(size=6) * (20.0, 20.0, 20.0, 2.0, 2.0, 2.0)
        at = hand(arm, q, qdot, mount, push)
        goal = ScipyRotation.from_matrix(at.R) * ScipyRotation.from_rotvec(turn * draw.normal(size=3) / 3**0.5)
        p_d = vector(np.array(at.chain.p) + 0.05 * draw.normal(size=3))
        v_d, f_d, m_d = (vector(draw.normal(scale=scale, size=3)) for scale in (0.1, 15.0, 1.5))
        setpoint = Setpoint(as_rotation(goal.as_matrix().T), p_d, v_d, f_d, m_d)
        found.append(((arm, q, qdot, mount, push), setpoint))
    return tuple(found)


def felt(at: Here):
    """(f, m), base frame, as the engines read them from MuJoCo's sensors."""
    return wrench(at.chain.R, at.data.sensordata)


def tick(one, at: Here, setpoint: Setpoint, held) -> Tick:
    """One tick of a controller, with the wrench that MuJoCo's sensors read."""
    n = at.chain.n
    into, about, J, tau = rows(), room(), np.zeros((6, n)), np.zeros(n)
    gains, touch = Gains(*map(np.float64, GAINS)), ContactParameters(*map(np.float64, TOUCH))
    f, m = (vector(three) for three in felt(at))
    with np.errstate(all="ignore"):
        one.assemble(at.chain, setpoint, f, m, gains, touch, J, into)
        form = FORMS.index(one.form) if one.form else 0
        comply(form, held, at.chain, at.D, at.fg, J, into, gains, touch, about, tau)
    return Tick(tau, J, into, about.y[:n] + np.linalg.solve(at.D, about.x[:n]))
