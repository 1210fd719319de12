"""What the engines of contact share: the settings of an episode, what is recorded at each tick, and how it ends."""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from bench.control.contact_controller import FORMS, ContactController
from bench.control.setpoint import TOUCH, ContactBuffers, ContactParameters, Rows
from bench.law.contender import PAPERS_GAINS, Gains
from bench.law.resolved_motion import Scratch
from bench.law.scalar import kernel
from bench.law.so3 import rotate
from tasks import verdict
from tasks.contact import Trial
from tasks.rules import RULES, ticks
from tasks.verdict import DIVERGED, GOING, SATURATED, SINGULAR

BROKEN = len(verdict.OUTCOMES)
"""MuJoCo gave up in the middle of a step: the code after the judge's."""

DONE = "done"
OUTCOMES = {GOING: DONE, DIVERGED: "diverged", SINGULAR: "singular", SATURATED: "saturated", BROKEN: "broken"}
"""How an episode ended: at its horizon, or by the judge's rules before it."""

TIME, R, OMEGA, P, FORCE, MOMENT, GAP, TURNED, LOAD = 0, 1, 10, 13, 16, 19, 22, 23, 24
WIDTH = 25
"""Columns of a record: time [s], columns of R, omega [rad/s], p [m], force [N] and moment [N m] on the hand, gap to the
scene [m], angle of the scene's joint [rad], largest torque over its rated one. Base frame."""


class Numbers(NamedTuple):
    """What a loop needs of an episode besides the models; see `Specification`, `ContactParameters`. legs: pushes."""

    dt: float
    ticks: int
    form: int
    speed_limit_squared: float
    torque_limit_squared: float
    held: tuple
    quat_d: tuple
    v_d: tuple
    f_d: tuple
    m_d: tuple
    rated: tuple
    legs: int


class Ended(NamedTuple):
    """An episode: its outcome (one of OUTCOMES' words), its record (ticks x WIDTH), and MuJoCo's words if it broke."""

    outcome: str
    record: np.ndarray
    message: str = ""


class Conditions(NamedTuple):
    """What is common to the episodes of a run."""

    gains: Gains = PAPERS_GAINS
    touch: ContactParameters = TOUCH
    dt_s: float = 1e-3
    integrator: str = "implicitfast"


USUAL = Conditions()
"""Implicit in the joints' own damping, as MuJoCo recommends for contacts."""


def numbers(controller: ContactController, trial: Trial, rated, horizon_s: float, conditions: Conditions) -> Numbers:
    """The numbers of one trial for one controller."""
    specification = trial.specification
    f_d, m_d = tuple(map(float, specification.desired_wrench[:3])), tuple(map(float, specification.desired_wrench[3:]))
    return Numbers(
        conditions.dt_s,
        ticks(horizon_s, conditions.dt_s),
        FORMS.index(controller.form) if controller.form else 0,
        RULES.speed_limit**2,
        RULES.torque_limit**2,
        controller.selection(specification),
        tuple(map(float, trial.goal_wxyz)),
        tuple(map(float, specification.velocity)),
        f_d,
        m_d,
        tuple(map(float, rated)),
        len(trial.pushes),
    )


def rows(dtype=float) -> Rows:
    """Fresh buffers for a controller's rows."""
    return Rows(*(np.zeros(6, dtype) for _ in Rows._fields))


def room(dtype=float) -> ContactBuffers:
    """Fresh buffers for `hybrid.comply`."""
    A, B, V = (np.zeros((6, 6), dtype) for _ in range(3))
    y, b, s, t = (np.zeros(6, dtype) for _ in range(4))
    return ContactBuffers(y, b, np.zeros((6, 6), dtype), Scratch(A, B, V, s, t))


@kernel
def wrench(R, s):
    """The force and moment on the hand, base frame.

    MuJoCo's sensors say what the hand does to the wrist's side of them, in the hand's frame.
    """
    return rotate(R, (-s[19], -s[20], -s[21])), rotate(R, (-s[22], -s[23], -s[24]))


@kernel
def moved(p, v, time):
    """p + v t."""
    return (p[0] + time * v[0], p[1] + time * v[1], p[2] + time * v[2])


@kernel
def overload(tau, rated, n):
    """(Sum of (tau_i / rated_i)^2, the largest of them): what the rule on torques is about; NaN if a torque is."""
    total, largest = 0.0, 0.0
    for i in range(n):
        ratio = tau[i] / rated[i]
        square = ratio * ratio
        total = total + square
        if square > largest:
            largest = square
    return total, largest


@kernel
def write_record(record, time, R, omega, p, f, m, gap, turned, load):
    """One tick's line."""
    record[0] = time
    for i in range(3):
        record[1 + i] = R.n[i]
        record[4 + i] = R.o[i]
        record[7 + i] = R.a[i]
        record[10 + i] = omega[i]
        record[13 + i] = p[i]
        record[16 + i] = f[i]
        record[19 + i] = m[i]
    record[22] = gap
    record[23] = turned
    record[24] = load


def made(record: np.ndarray, failure: int, ticks: int, message: str, data: Any) -> Ended:
    """The episode of a filled record; broken if MuJoCo left out contacts or constraints for want of memory."""
    kinds = (mujoco.mjtWarning.mjWARN_CONTACTFULL, mujoco.mjtWarning.mjWARN_CNSTRFULL)
    left_out = [kind.name for kind in kinds if data.warning[kind].number]
    if failure != BROKEN and left_out:
        failure, message = BROKEN, ", ".join(left_out)
    return Ended(OUTCOMES[failure], record[:ticks], message)


def blank(shape: Numbers) -> np.ndarray:
    """A record to be filled."""
    return np.full((shape.ticks, WIDTH), np.nan)


def sensors_of(model: Any) -> tuple[int, int]:
    """Where the gap and the scene's joint are among the sensor values; -1 if the task has none."""
    names = [model.sensor(i).name for i in range(model.nsensor)]
    at = {name: int(model.sensor_adr[i]) for i, name in enumerate(names)}
    return at.get("gap", -1), at.get("turned", -1)
