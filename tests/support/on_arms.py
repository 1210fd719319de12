"""An arm in one state: what its controller sees there, by MuJoCo, and the controller called on it as plain Python."""

import functools
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.engines.arm_episode import buffers
from bench.engines.binding import command_of, memory_of
from bench.law.chain import Chain
from bench.law.contenders import combinations
from bench.law.contenders.registry import all_contenders
from bench.law.control.resolved_acceleration import assembly, control, parts_of
from bench.law.inputs import Gains, Goal, Tuning
from bench.law.so3 import Rotation, from_quaternion
from support.buffers import bias_of, chain_of, inertia_of, jacobian_of
from support.states import vector
from tasks.arm_model import model_xml

ARMS = tasks.arm_names()
LAWS = {one.name: one for one in all_contenders()}
GAINS = Gains(kp=37.0, kv=9.0)  # not the defaults: what has those built in is found out


def named(arm: str, word: str):
    """A contender by its word, with the standard inverse of the arm if that is what it says."""
    [one] = combinations.on((word,), LAWS, tasks.arm(arm).joints)
    return one


class Here(NamedTuple):
    """A state of an arm at a site: J, drift = Jdot qdot, D, fg and the wrench F by MuJoCo; what the controller sees."""

    model: mujoco.MjModel
    data: mujoco.MjData
    chain: Chain
    J: np.ndarray
    drift: np.ndarray
    D: np.ndarray
    fg: np.ndarray
    F: np.ndarray

    @property
    def n(self) -> int:
        """Joints."""
        return self.model.nv

    @property
    def R(self) -> np.ndarray:
        """The site's orientation, 3 x 3."""
        return np.array(self.chain.R).T

    @property
    def velocity(self) -> np.ndarray:
        """(pdot, omega), base frame."""
        return self.J @ self.chain.qdot

    def acceleration(self, tau) -> np.ndarray:
        """(pddot, omegadot) under these torques and the wrench, by MuJoCo's forward dynamics."""
        self.data.ctrl[:] = tau
        mujoco.mj_forward(self.model, self.data)
        return self.J @ self.data.qacc + self.drift


@functools.cache
def simulated(arm: str):
    """One model and its data for all states of an arm."""
    model = mujoco.MjModel.from_xml_string(model_xml(tasks.arm(arm), 1e-3))
    return model, mujoco.MjData(model)


def here(arm: str, q, qdot) -> Here:
    """An arm in that state; valid until the next one is asked for."""
    model, data = simulated(arm)
    mujoco.mj_resetData(model, data)
    data.qpos[:], data.qvel[:] = q, qdot
    return at_site(model, data, "tool")


def at_site(model, data, site: str, push=(0.0,) * 6) -> Here:
    """Return the state of a model; of a push (f, m) on the site's body the wrench about the site."""
    mujoco.mj_forward(model, data)
    J, drift, D = jacobian_of(model, data, site), bias_of(model, data, site), inertia_of(model, data)
    place, (f, m) = data.site(site).xpos, np.reshape(push, (2, 3))
    F = np.concatenate((f, m + np.cross(data.xipos[model.site(site).bodyid[0]] - place, f)))
    return Here(model, data, chain_of(model, data, site), J, drift, D, data.qfrc_bias - data.qfrc_passive, F)


def torques(one, at: Here, goal_wxyz, p_d, gains=GAINS):
    """tau and the commanded angular acceleration u of one tick, from the law's initial memory."""
    into = buffers(at.n)
    R_d = Rotation(*map(vector, from_quaternion(goal_wxyz)))
    goal = Goal(R_d, vector((0.0, 0.0, 0.0)), vector((0.0, 0.0, 0.0)))
    with np.errstate(all="ignore"):
        u, _ = control(
            assembly(parts_of(one, command_of(one))), one.inverse.resolve, int(one.inverse.gives == "torque"), one.rows,
            at.chain, at.D, at.fg, goal, vector(p_d), Tuning(*map(np.float64, gains)), memory_of(one), into,
        )  # fmt: skip
    return into.tau.copy(), np.array(u)
