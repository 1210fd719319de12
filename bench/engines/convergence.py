"""The continuous plant: every episode by two steps, and by ever shorter ones until how it ends no longer moves.

An episode is run at twice the control period and at the control period, by Runge-Kutta of order 4. If both end alike,
halving the step moved nothing, and the second is its row: at twice the step the error is sixteen times as large. What
does not agree is run by `refined`, at LEVELS of it, each with a step of half as long (an error of a 32nd) where the
path asks for it, and a 32nd as long where it must stop; until two that follow each other end alike. The last is the
row, and its step is the shortest that was taken. If none agree, the episode has not converged, which the row says.

Alike: the same outcome; a settling time that moved by no more than one control period (of two runs with different
periods, beyond the coarser one's sampling); an unsettled body at the same angle to SAME_RAD. A failure (diverged,
saturated or singular) counts if it came with the first command or by steps that were good enough all along: what is
integrated too coarsely beside a pole fails at any step. Which of the three it is, the finer of the two runs says.

Does not converge: what depends on rounding (an exact 180° rotation that is left at all), and what passes a place where
the command has no limit in a way that depends on the step.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.engines.episode import FAILURE_TICK, FINAL_ANGLE, OUTCOME, SETTLING_TICK, STEP, Numbers, Settings
from tasks.rules import RULES
from tasks.verdict import DIVERGED, SATURATED, SETTLED, SINGULAR

SAME_RAD = RULES.floor_rad
FAILED = (DIVERGED, SATURATED, SINGULAR)


class Level(NamedTuple):
    """Control of the step: the difference of a step from its two halves that is good enough, and when to stop halving.

    divisions: of a control period, into the shortest steps that are taken whatever they differ by.
    """

    tolerance: float
    divisions: int


LEVELS = tuple(Level(2.0 ** -(15 + 5 * n), 2 ** (8 + 5 * n)) for n in range(6))
"""From 3e-5 and 4 us to 1e-12 and 0.1 ps, at a control period of 1 ms."""

MORE_STEPS = 2**14
"""After so many steps beside one for each control period of the horizon an episode is given up: 10 ms of computing."""


def coarser(settings: Settings) -> Settings:
    """Return the settings at twice the control period."""
    return settings._replace(
        dt_s=2.0 * settings.dt_s, ticks=(settings.ticks + 1) // 2, hold_ticks=(settings.hold_ticks + 1) // 2
    )


def at_level(numbers: Numbers, level: Level) -> Numbers:
    """Return the numbers for `refined`."""
    most = numbers.ticks + MORE_STEPS
    return numbers._replace(tolerance_squared=level.tolerance**2, divisions=level.divisions, most_steps=most)


def converged(
    once: Callable[[Settings], np.ndarray],
    again: Callable[[Level, np.ndarray], np.ndarray],
    settings: Settings,
) -> np.ndarray:
    """Return rows of all episodes, STEP of each the step at which it has converged [s]; negative if it has not.

    once(settings): rows of all by Runge-Kutta, a step a control period; again(level, which): of some by `refined`.
    """
    rows = once(settings)
    left = np.flatnonzero(~alike(once(coarser(settings)), rows, 2))
    rows[:, STEP] = settings.dt_s
    rows[left, STEP] = -settings.dt_s
    for level in LEVELS:
        if not len(left):
            break
        finer = again(level, left)
        is_whole = ~np.isnan(finer[:, STEP])
        is_same = is_whole & alike(rows[left], finer, 1)
        finer[:, STEP] = np.where(is_same, 1.0, -1.0) * np.abs(finer[:, STEP])
        rows[left[is_whole]] = finer[is_whole]
        left = left[is_whole & ~is_same]
    return rows


def alike(coarse: np.ndarray, fine: np.ndarray, ticks: int) -> np.ndarray:
    """Whether episodes end alike; the first rows' control period is so many of the second's."""
    outcome = fine[:, OUTCOME]
    later = ticks * coarse[:, SETTLING_TICK] - fine[:, SETTLING_TICK]
    turned = np.abs(coarse[:, FINAL_ANGLE] - fine[:, FINAL_ANGLE])
    is_sure = (fine[:, STEP] > 0.0) | ((coarse[:, FAILURE_TICK] == 0) & (fine[:, FAILURE_TICK] == 0))
    is_failure = np.isin(coarse[:, OUTCOME], FAILED) & np.isin(outcome, FAILED) & is_sure
    is_end = np.where(outcome == SETTLED, (later >= -1) & (later <= ticks), turned <= SAME_RAD)
    return is_failure | ((coarse[:, OUTCOME] == outcome) & ~np.isin(outcome, FAILED) & is_end)
