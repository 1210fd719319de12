"""What every engine is given and gives back: settings, one row of numbers in and one row out per episode.

A row out begins with OUTCOME to STEP, which `finish` writes from the judge (tasks/verdict.py), and
goes on with a number for each metric. `bench.experiments.episode_rows` makes the columns of a table
of it: `settling_time_s` is SETTLING_TICK times the control period.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from bench.law.inputs import Gains
from bench.law.scalar import kernel
from bench.law.so3 import Rotation
from tasks.base import Start
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import CRASHED, GOING, SETTLED, SINGULAR, verdict

Starts: TypeAlias = Sequence[Start]
Metrics: TypeAlias = Sequence[Any]


class Settings(NamedTuple):
    """How episodes are run; every field is a column of the results or follows from one.

    dt_s: control period and integration step; ticks: horizon in ticks; hold_ticks: how long the angle must have
    stayed under a hundredth of the band before an engine may stop early.
    """

    gains: Gains
    dt_s: float
    ticks: int
    hold_ticks: int
    command_limit: float = RULES.command_limit
    speed_limit: float = RULES.speed_limit
    rest_speed: float = RULES.rest_speed
    rest_command: float = RULES.rest_command
    torque_limit: float = RULES.torque_limit


class Numbers(NamedTuple):
    """Settings as a compiled loop takes them: floats and integers only.

    tolerance_squared, divisions, most_steps: those of `refined`. bound [rad/s^2], delay [s]: the limits of
    its motors that a law can read (`bench.law.inputs.Tuning`); the plant applies its own condition.
    """

    kp: float
    kv: float
    dt: float
    ticks: int
    hold_ticks: int
    rest_ticks: int
    slow_squared: float
    command_limit_squared: float
    speed_limit_squared: float
    rest_speed_squared: float
    rest_command_squared: float
    tolerance_squared: float = 0.0
    divisions: int = 1
    most_steps: int = 0
    bound: float = math.inf
    delay: float = 0.0


class Sample(NamedTuple):
    """What a metric sees at one tick, before the plant moves.

    time [s], dt [s], R, haversine = sin^2(angle/2), entered (whether the angle has been inside the band), at_rest
    (inside the band and slow), omega [rad/s], u and the command before it [rad/s^2] in the base frame, margin of the
    representation (NaN for a law on R).
    """

    time: float
    dt: float
    R: Rotation
    haversine: float
    entered: bool
    at_rest: bool
    omega: tuple
    u: tuple
    before: tuple
    margin: float


START_WIDTH = 12
"""Columns of a start: quaternion 0-3, omega 4-6, goal quaternion 7-10, haversine of the settling band 11."""

NEVER = -1
OUTCOME, SETTLING_TICK, FAILURE_TICK, TICKS, FINAL_ANGLE, STEP = range(6)
FIRST_METRIC = 6
"""STEP: of the continuous plant, the step at which an episode has converged, see `convergence`; of others zero."""


def numbers(settings: Settings) -> Numbers:
    """Return the settings for a compiled loop; limits squared, so that no loop takes a root to compare."""
    return Numbers(
        float(settings.gains.kp),
        float(settings.gains.kv),
        float(settings.dt_s),
        int(settings.ticks),
        int(settings.hold_ticks),
        RULES.hold_ticks(settings.dt_s),
        RULES.slow_squared,
        settings.command_limit**2,
        settings.speed_limit**2,
        settings.rest_speed**2,
        settings.rest_command**2,
    )


CRASHED_COMMAND = (math.nan, math.nan, 3e-300)
"""What the guard of a user's law commands in its place (`binding`); by accident no law does."""


@kernel
def has_crashed(u):
    """Return whether u is CRASHED_COMMAND, (NaN, NaN, 3e-300): a user's law raised an error."""
    return u[0] != u[0] and u[1] != u[1] and u[2] == CRASHED_COMMAND[2]


@kernel
def attribute_crash(failure, u):
    """Return CRASHED in place of SINGULAR if the law raised an error; else the failure itself."""
    if failure == SINGULAR and has_crashed(u):
        return CRASHED
    return failure


@kernel
def finish(row, failure, watch, tick, angle, speed_squared, command_squared, numbers):
    """Write the judge's columns of one episode."""
    outcome = verdict(
        failure, watch, tick, numbers.rest_ticks,
        speed_squared, command_squared, numbers.rest_speed_squared, numbers.rest_command_squared,
    )  # fmt: skip
    row[OUTCOME] = outcome
    row[SETTLING_TICK] = watch.settled_since if outcome == SETTLED else NEVER
    row[FAILURE_TICK] = NEVER if failure == GOING else tick
    row[TICKS] = tick
    row[FINAL_ANGLE] = angle


def start_rows(starts: Starts) -> np.ndarray:
    """Return the judge's starts as rows: quaternion, omega, goal, haversine of the settling band."""
    rows = np.empty((len(starts), START_WIDTH))
    for row, start in zip(rows, starts, strict=True):
        band = RULES.band_haversine(angle(start.quat_wxyz, start.goal_wxyz))
        row[:] = (*start.quat_wxyz, *start.omega, *start.goal_wxyz, band)
    return rows


def blank(count: int, metrics: Metrics = (), more: tuple[float, ...] = ()) -> np.ndarray:
    """Rows to be filled: every metric at its start value, then the start values of columns behind them."""
    return np.tile([0.0] * FIRST_METRIC + [metric.start for metric in metrics] + [*more], (count, 1))
