"""Episodes of bodies that turn freely: perturbed, behind goals that come as a stream, and by laws with a state."""

import functools
import math
from typing import Any

import numpy as np

from bench.engines import episode
from bench.engines.binding import memory_of
from bench.engines.compiled import compile_once, part
from bench.engines.episode import Metrics, Numbers, Settings, Starts, blank, numbers, start_rows
from bench.engines.plants import perturbed, quaternion
from bench.engines.signatures import BEGIN_STATE, STATEFUL
from bench.engines.simulate import compiled_loop, evaluation, simulate
from bench.law.contender import Contender
from bench.law.inputs import NO_MEMORY, Gains
from bench.law.kinds import Stateful
from bench.law.scalar import kernel
from tasks.condition import Condition
from tasks.rules import RULES

NOISE_BYTES = 64e6
"""Bytes of noise held at once: 266 starts of 5 s, measured every millisecond. A thousand, 246 MB, run in blocks.
The default suite's 24 are one block, so that all its laws share one draw."""


def run_disturbed(
    contender: Contender, starts: Starts, condition: Condition, settings: Settings, metrics: Metrics, seed: int = 0,
    noise_bytes: float = NOISE_BYTES,
) -> np.ndarray:  # fmt: skip
    """Return rows of `engines.episode`, one a start, with `perturbed.EXTRA` columns more; settling counts from a jump.

    dt_s is the condition's. seed: of the noise, which is the same for every contender.
    """
    rows, begun = blank(len(starts), metrics, (0.0,) * perturbed.EXTRA), start_rows(starts)
    horizon_s = settings.ticks * settings.dt_s
    limits = perturbed.in_steps(numbers(settings), condition, RULES.hold_s, horizon_s)
    periods = limits.ticks // perturbed.steps_of(condition) + 1
    block = max(1, int(noise_bytes // (8 * 6 * periods))) if condition.is_noisy else len(starts)
    law, memory, loop = (evaluation(contender),), memory_of(contender), compiled_loop("perturbed", tuple(metrics))
    for first in range(0, len(starts), block):
        some = slice(first, first + block)
        noise = draw_noise(first, len(begun[some]), periods, seed) if condition.is_noisy else np.zeros((1, 1, 6))
        simulate(loop, law, perturbed.world(condition, noise, rows[some]), memory, begun[some], limits, rows[some])
    has_settled = rows[:, episode.SETTLING_TICK] != episode.NEVER
    rows[has_settled, episode.SETTLING_TICK] -= perturbed.timing(condition).jump
    return rows


@functools.lru_cache(maxsize=1)
def draw_noise(first: int, count: int, periods: int, seed: int) -> np.ndarray:
    """Draw six numbers of unit standard deviation for every period of some starts; first: the number of the first."""
    noise = np.empty((count, periods, 6))
    for k in range(count):
        np.random.default_rng((seed, first + k)).standard_normal(out=noise[k])
    return noise


def _unlimited(gains: Gains, dt: float, ticks: int) -> Numbers:
    """Return a loop's numbers of so many ticks that no limit ends, nor does rest."""
    return Numbers(*gains, dt, ticks, ticks + 1, 1, *(math.inf,) * 3, 0.0, 0.0)


def run_stream(
    contender: Contender, goals: np.ndarray, truth: np.ndarray, gains: Gains, dt: float, is_raw: bool = False
) -> tuple[float, float, float]:
    """Return greatest |u| [rad/s^2], greatest angle to the true goal [rad] and path turned [rad] of one episode.

    From rest at the first true goal, as long as the stream lasts, whatever becomes of it. goals, truth: one a tick
    (n x 4). is_raw: the spring on the quaternion as it came, in the law's place.
    """
    start, rows = np.zeros((1, episode.START_WIDTH)), np.zeros((1, quaternion.PATH + 1))
    start[0, 0:4], start[0, 7:11] = truth[0], goals[0]
    stream, limits = (
        quaternion.SentGoals(goals, truth, int(is_raw)),
        _unlimited(gains, dt, len(goals)),
    )
    simulate(compiled_loop("stream"), (evaluation(contender),), stream, memory_of(contender), start, limits, rows)
    peak, off, way = rows[0, quaternion.PEAK :].tolist()
    return peak, off, way


def parts_of(one: Stateful) -> tuple:
    """Compile a law with a state, or take it from the disk cache."""
    return part(one.law.law, STATEFUL), part(one.begin, BEGIN_STATE)


def run_compensated(
    one: Stateful, starts: Starts, gains: Gains, dt: float, ticks: int, band: float, push: tuple, is_plain: bool = False
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Simulate starts, from their orientation and angular velocity.

    Return of each the time after which the angle stays in the band [s], NaN if it does not, the angle at the end [rad]
    and the greatest |u| [rad/s^2]. band: half its width [rad]. push: constant disturbance [rad/s^2], base frame.
    is_plain: by the loop in Python.
    """
    loop = quaternion.with_state() if is_plain else compiled_loop("state")
    parts = (one.law.law, one.begin) if is_plain else parts_of(one)
    begun, rows = start_rows(starts), np.zeros((len(starts), quaternion.PEAK + 1))
    begun[:, 11] = math.sin(0.5 * band) ** 2
    simulate(loop, parts, quaternion.Disturbance(push), NO_MEMORY, begun, _unlimited(gains, dt, ticks), rows)
    left = rows[:, episode.FINAL_ANGLE]
    return np.where(left <= band, rows[:, episode.SETTLING_TICK] * dt, math.nan), left, rows[:, quaternion.PEAK]


@kernel
def nothing(R: Any) -> tuple:
    """No state."""
    return NO_MEMORY


@compile_once
def without_state(one: Any) -> Stateful:
    """Return a law without memory as one with a state, which stays at zero."""
    law = one.law

    @kernel
    def still(R: Any, omega: Any, goal: Any, gains: Any, state: Any) -> Any:
        return law(R, omega, goal, gains), NO_MEMORY

    return Stateful(one._replace(law=still), nothing, polynomial=None, measures_rate=True, rejects=False)
