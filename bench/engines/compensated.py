"""A free body turned by a law with a state of its own, under a constant disturbance: rows of what becomes of it."""

import math
from typing import NamedTuple

import numpy as np

from bench.engines.compiled import BEGIN_STATE, STATEFUL, compile_function, made_once
from bench.engines.episode import FINAL_ANGLE, SETTLING_TICK, Numbers, start_rows
from bench.engines.plants import quaternion
from bench.engines.simulate import compiled_loop, simulate
from bench.law.inputs import NO_MEMORY, Gains
from bench.law.kinds import Law, State
from bench.law.scalar import kernel

SETTLED, LEFT, PEAK = range(3)
"""A row's columns: time after which the angle stays in the band [s], NaN if it does not; angle at the end [rad];
greatest |u| [rad/s^2]."""


class Asked(NamedTuple):
    """Period [s], ticks, band [rad], and the disturbance along base axes [rad/s^2]."""

    dt: float
    ticks: float
    band: float
    x: float
    y: float
    z: float


@made_once
def _parts(one: Law):
    return compile_function(one.law, STATEFUL), compile_function(one.state.begin, BEGIN_STATE)


def prepare(one: Law) -> None:
    """Compile what `run` will need, or take it from the disk cache."""
    compiled_loop("state")
    _parts(one)


def run(one: Law, starts, gains: Gains, asked: Asked) -> np.ndarray:
    """Rows (SETTLED, LEFT, PEAK), one per start, from its orientation and angular velocity."""
    return rows_of(compiled_loop("state"), _parts(one), starts, gains, asked)


def rows_of(loop, parts: tuple, starts, gains: Gains, asked: Asked) -> np.ndarray:
    """Return the rows of a loop of `quaternion.with_state`; no limit ends its episodes, nor does rest."""
    begun, rows, ticks = start_rows(starts), np.zeros((len(starts), quaternion.PEAK + 1)), int(asked.ticks)
    begun[:, 11] = math.sin(0.5 * asked.band) ** 2
    limits = Numbers(*gains, asked.dt, ticks, ticks + 1, 1, *(math.inf,) * 3, 0.0, 0.0)
    simulate(loop, parts, quaternion.Disturbance(asked[3:]), NO_MEMORY, begun, limits, rows)
    is_in = rows[:, FINAL_ANGLE] <= asked.band
    times = np.where(is_in, rows[:, SETTLING_TICK] * asked.dt, math.nan)
    return np.column_stack((times, rows[:, FINAL_ANGLE], rows[:, quaternion.PEAK]))


@kernel
def nothing(R):
    """No state."""
    return (0.0, 0.0, 0.0, 0.0)


@made_once
def without_state(one) -> Law:
    """Return a law without memory as one with a state, which stays at zero."""
    law = one.law

    @kernel
    def still(R, omega, goal, gains, state):
        return law(R, omega, goal, gains), (0.0, 0.0, 0.0, 0.0)

    return one._replace(law=still, state=State(nothing, None, measures_rate=True, rejects=False))
