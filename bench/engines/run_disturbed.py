"""One call for the free body in trouble: a contender on starts under a condition, rows of numbers back."""

import functools

import numpy as np

from bench.contender import Contender
from bench.engines import disturbed
from bench.engines.binding import memory_of, observer
from bench.engines.episode import Settings, numbers, start_rows
from bench.engines.run import evaluation
from tasks.condition import Condition
from tasks.rules import RULES


def run(contender: Contender, starts, condition: Condition, settings: Settings, metrics, seed: int = 0) -> np.ndarray:
    """Rows of `engines.episode`, one a start, with `disturbed.EXTRA` columns more.

    Args:
        settings: gains and limits; dt_s is the condition's.
        seed: of the noise, which is the same for every contender.
    """
    rows = disturbed.blank_rows(len(starts), metrics)
    horizon_s = settings.ticks * settings.dt_s
    given = disturbed.in_steps(numbers(settings), condition, RULES.hold_s, horizon_s)
    noise = drawn(len(starts), given.ticks // disturbed.steps_of(condition) + 1, seed, condition.is_noisy)
    loop = _loop(tuple(metrics))
    trouble = disturbed.trouble(condition)
    loop(evaluation(contender), memory_of(contender), start_rows(starts), noise, given, trouble, rows)
    return rows


def drawn(count: int, periods: int, seed: int, is_noisy: bool) -> np.ndarray:
    """Six numbers of unit standard deviation for every start and period; of a condition without noise, zeros."""
    if not is_noisy:
        return np.zeros((1, 1, 6))
    return _normal(count, periods, seed)


@functools.lru_cache(maxsize=1)
def _normal(count: int, periods: int, seed: int) -> np.ndarray:
    return np.stack([np.random.default_rng((seed, k)).standard_normal((periods, 6)) for k in range(count)])


@functools.cache
def _loop(metrics: tuple):
    return disturbed.compiled(observer(metrics))
