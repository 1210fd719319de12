"""Feedback linearization over the pole: starts that are lost, against the step of integration.

Only starts whose linear beta(t) crosses a pole are simulated; of all others the maps lose next to none.
"""

import math
from collections.abc import Iterator

import numpy as np

from bench.engines.episode import OUTCOME
from bench.engines.simulate import by_equal_steps
from bench.experiments.experiment import Settings
from bench.experiments.map import start_rows
from bench.findings.maps import lost_share
from bench.law.contender import PAPERS_GAINS
from bench.law.contenders.registry import find_contender
from report.figures.kit.rows import SHORT
from tasks.random_starts import BLOCK, block
from tasks.verdict import DIVERGED, SATURATED, SINGULAR

SPEED, STARTS = 20.0, BLOCK
DIVISIONS = (1, 2, 4, 8, 16, 32)
HORIZON_S = 0.5
"""What is thrown out at a pole is so by then: beta(t) has its extremum before 1/w = 0.1 s."""


def crossing(quats: np.ndarray, omegas: np.ndarray) -> np.ndarray:
    """Whether the linear beta(t) of each start passes +-pi/2 (`closed_form.pole_crossings`)."""
    w, x, y, z = quats.T
    nx, ny, nz = w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)
    flat, rate = np.hypot(nx, ny), PAPERS_GAINS.kv / 2.0
    beta, rising = np.arctan2(-nz, flat), (nx * omegas[:, 1] - ny * omegas[:, 0]) / flat
    beta, rising = np.where(rising < 0.0, -beta, beta), np.abs(rising)
    v = rising + rate * beta
    highest = np.exp(-rising / np.where(v > 0.0, v, 1.0)) * v / rate
    return (v > 0.0) & (highest > math.pi / 2.0)


def rows() -> Iterator[tuple]:
    """Step [us], share lost [%] with its interval, and how many of them the step before lost too."""
    quats, omegas = block(0, 0, SPEED, SPEED)
    chosen = crossing(quats, omegas)
    begun, one, before = start_rows(quats[chosen], omegas[chosen]), find_contender(SHORT["f"]), None
    limits = Settings().limits(HORIZON_S)
    for divisions in DIVISIONS:
        outcomes = by_equal_steps(one, begun, limits, divisions)[:, OUTCOME]
        lost = np.isin(outcomes, (DIVERGED, SATURATED, SINGULAR))
        share = [100.0 * number for number in lost_share(int(lost.sum()), STARTS)]
        again = None if before is None else int((lost & before).sum())
        yield 1e6 * limits.dt_s / divisions, share[0], f"{share[1]:.2f} to {share[2]:.2f}", int(lost.sum()), again
        before = lost
