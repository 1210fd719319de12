"""What the engines of contact share: the settings of an episode, what is recorded at each tick, and how it ends."""

import functools
from typing import Any, NamedTuple

import mujoco
import numpy as np

from bench.engines import episode
from bench.engines.arm_episode import MOST, scratch
from bench.engines.arrays import Four, Seven, Six, Three
from bench.law.control.contact_controller import FORMS, ContactController
from bench.law.control.setpoint import TOUCH, ContactBuffers, ContactParameters, Rows, Setpoint
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.law.scalar import kernel
from bench.law.so3 import rotate
from tasks import verdict
from tasks.contact import ContactTask, Trial
from tasks.contact_rest import RestNumbers, rest_numbers
from tasks.rules import RULES, ticks
from tasks.verdict import DIVERGED, GOING, SATURATED, SINGULAR

BROKEN = len(verdict.OUTCOMES)
"""MuJoCo gave up in the middle of a step: the code after the judge's."""

RESTED = BROKEN + 1
"""The hand came to rest, and the episode ended there."""

DONE = "done"
OUTCOMES = {GOING: DONE, DIVERGED: "diverged", SINGULAR: "singular", SATURATED: "saturated", BROKEN: "broken"}
"""How an episode ended: at rest or at its horizon, or by the judge's rules before it."""

TIME, R, OMEGA, P, FORCE, MOMENT, GAP, TURNED, LOAD = 0, 1, 10, 13, 16, 19, 22, 23, 24
WIDTH = 25
"""Columns of a record: time [s], columns of R, omega [rad/s], p [m], force [N] and moment [N m] on the hand, gap to the
scene [m], angle of the scene's joint [rad], largest torque over its rated one. Base frame."""


class ContactNumbers(NamedTuple):
    """What a loop needs of an episode besides the models and its limits; see `Specification`, `ContactParameters`.

    rated: seven numbers, filled up with ones on fewer joints; is_cut: 1 if motors give no more. moves_s: until when the
    place moves [s]. legs: pushes. rest: when it is over. sensor_ticks: between two readings of the wrench.
    """

    form: int
    held: Six
    quat_d: Four
    v_d: Three
    f_d: Three
    m_d: Three
    rated: Seven
    legs: int
    moves_s: float
    rest: RestNumbers
    is_cut: int
    sensor_ticks: int


class EndedEpisode(NamedTuple):
    """An episode: its outcome (one of OUTCOMES' words), its record (ticks x WIDTH), and MuJoCo's words if it broke.

    rested: whether it ended because the hand was at rest.
    """

    outcome: str
    record: np.ndarray
    message: str = ""
    rested: bool = False


class Sensor(NamedTuple):
    """Hold what a force sensor does: how long a reading lasts [s], and the noise of each reading.

    force [N], moment [N m]: standard deviations of normal noise, independent along and about the axes of the base.
    """

    period_s: float = 0.0
    force: float = 0.0
    moment: float = 0.0

    def draw_noise(self, duration_s: float, dt_s: float) -> np.ndarray:
        """Return the noise of each reading of an episode, n x 6, the same for all episodes of one sensor."""
        readings = 1
        if self.force or self.moment:
            readings += int(duration_s / max(self.period_s, dt_s))
        return draw_readings(readings, self.force, self.moment)


@functools.lru_cache(maxsize=4)
def draw_readings(readings: int, force: float, moment: float) -> np.ndarray:
    """Return normal noise of these standard deviations, readings x 6; every caller gets the same array.

    To draw it takes 0.2 ms: a twentieth of an episode that is probed.
    """
    noise = np.random.default_rng(0).normal(size=(readings, 6))
    return noise * np.repeat((force, moment), 3)


class Conditions(NamedTuple):
    """What is common to the episodes of a run; is_cut: whether motors give no more than their rated torque."""

    gains: Gains = PAPERS_GAINS
    touch: ContactParameters = TOUCH
    dt_s: float = 1e-3
    integrator: str = "implicitfast"
    is_cut: bool = False
    sensor: Sensor = Sensor()


USUAL = Conditions()
"""Implicit in the joints' own damping, as MuJoCo recommends for contacts."""


def numbers(
    controller: ContactController, task: ContactTask, trial: Trial, rated: tuple, conditions: Conditions
) -> ContactNumbers:
    """Return the numbers of one trial for one controller."""
    specification = trial.specification
    f_d, m_d = tuple(map(float, specification.desired_wrench[:3])), tuple(map(float, specification.desired_wrench[3:]))
    return ContactNumbers(
        FORMS.index(controller.form) if controller.form else 0,
        controller.selection(specification),
        tuple(map(float, trial.goal_wxyz)),
        tuple(map(float, specification.velocity)),
        f_d,
        m_d,
        (*map(float, rated), *[1.0] * (MOST - len(rated))),
        len(trial.pushes),
        float(specification.moves_s),
        rest_numbers(task.rests, min(specification.moves_s, task.horizon_s), conditions.dt_s),
        int(conditions.is_cut),
        ticks(conditions.sensor.period_s, conditions.dt_s),
    )


def limits(task: ContactTask, conditions: Conditions) -> episode.Numbers:
    """Return the loop's numbers of a trial: no angle ends it, and torques over rated ones are its command."""
    dt, count = conditions.dt_s, ticks(task.horizon_s, conditions.dt_s)
    return episode.numbers(episode.Settings(conditions.gains, dt, count, count + 1, RULES.torque_limit))


def rows(dtype: Any = float) -> Rows:
    """Fresh buffers for a controller's rows."""
    return Rows(*np.zeros((len(Rows._fields), 6), dtype))


def room(dtype: Any = float) -> ContactBuffers:
    """Fresh buffers for `hybrid.comply`."""
    y, b, x = np.zeros((3, MOST), dtype)
    return ContactBuffers(y, b, x, np.zeros((6, MOST), dtype), scratch(dtype))


@kernel
def wrench(R, s):
    """Return the force and moment on the hand, base frame.

    MuJoCo's sensors say what the hand does to the wrist's side of them, in the hand's frame.
    """
    return rotate(R, (-s[19], -s[20], -s[21])), rotate(R, (-s[22], -s[23], -s[24]))


@kernel
def setpoint(R_d, p_0, numbers, time):
    """Return what is wanted at a time [s]: the place moves at v_d until moves_s."""
    v, moved = numbers.v_d, time
    if time >= numbers.moves_s:
        v, moved = (0.0, 0.0, 0.0), numbers.moves_s
    v_d = numbers.v_d
    p_d = (p_0[0] + moved * v_d[0], p_0[1] + moved * v_d[1], p_0[2] + moved * v_d[2])
    return Setpoint(R_d, p_d, v, numbers.f_d, numbers.m_d)


def made(record: np.ndarray, failure: int, ticks: int, message: str, data: Any) -> EndedEpisode:
    """Return the episode of a filled record; broken if MuJoCo left out contacts or constraints for want of memory."""
    kinds = (mujoco.mjtWarning.mjWARN_CONTACTFULL, mujoco.mjtWarning.mjWARN_CNSTRFULL)
    left_out = [kind.name for kind in kinds if data.warning.number[kind]]
    if failure != BROKEN and left_out:
        failure, message = BROKEN, ", ".join(left_out)
    return EndedEpisode(
        OUTCOMES[GOING if failure == RESTED else failure],
        record[:ticks],
        message,
        failure == RESTED,
    )


def sensors_of(model: Any) -> tuple[int, int]:
    """Return the places of the gap and of the scene's joint among the sensor values; -1 if the task has none."""
    names = [model.sensor(i).name for i in range(model.nsensor)]
    at = {name: int(model.sensor_adr[i]) for i, name in enumerate(names)}
    return at.get("gap", -1), at.get("turned", -1)
