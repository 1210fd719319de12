"""Episodes of the perturbed free body: a contender on starts under a condition, rows of numbers back."""

import functools

import numpy as np

from bench.engines.binding import memory_of
from bench.engines.episode import Settings, blank, numbers, start_rows
from bench.engines.plants import perturbed
from bench.engines.simulate import compiled_loop, evaluation, simulate
from bench.law.contender import Contender
from tasks.condition import Condition
from tasks.rules import RULES

NOISE_BYTES = 64e6
"""Of noise held at once: 266 starts of 5 s, asked every millisecond. A thousand would be 246 MB; they run in blocks.
The default suite's 24 are one block, so that all its laws share one draw."""


def run_disturbed(
    contender: Contender,
    starts,
    condition: Condition,
    settings: Settings,
    metrics,
    seed: int = 0,
    noise_bytes: float = NOISE_BYTES,
) -> np.ndarray:
    """Rows of `engines.episode`, one a start, with `perturbed.EXTRA` columns more.

    Args:
        settings: gains and limits; dt_s is the condition's.
        seed: of the noise, which is the same for every contender.
    """
    rows, begun = blank(len(starts), metrics, (0.0,) * perturbed.EXTRA), start_rows(starts)
    horizon_s = settings.ticks * settings.dt_s
    limits = perturbed.in_steps(numbers(settings), condition, RULES.hold_s, horizon_s)
    periods = limits.ticks // perturbed.steps_of(condition) + 1
    block = max(1, int(noise_bytes // (8 * 6 * periods))) if condition.is_noisy else len(starts)
    law, memory, loop = (evaluation(contender),), memory_of(contender), compiled_loop("perturbed", tuple(metrics))
    for first in range(0, len(starts), block):
        some = slice(first, first + block)
        noise = drawn(len(begun[some]), periods, seed, condition.is_noisy, first)
        simulate(loop, law, perturbed.world(condition, noise), memory, begun[some], limits, rows[some])
    return rows


def drawn(count: int, periods: int, seed: int, is_noisy: bool, first: int = 0) -> np.ndarray:
    """Six numbers of unit standard deviation for every start and period; of a condition without noise, zeros.

    Args:
        first: the number of the first start.
    """
    return _normal(first, count, periods, seed) if is_noisy else np.zeros((1, 1, 6))


@functools.lru_cache(maxsize=1)
def _normal(first: int, count: int, periods: int, seed: int) -> np.ndarray:
    noise = np.empty((count, periods, 6))
    for k in range(count):
        np.random.default_rng((seed, first + k)).standard_normal(out=noise[k])
    return noise
