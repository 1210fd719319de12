"""Where a law first fails, along geodesics from the goal: a scan for the first failing angle, then bisection.

A failing set of measure zero (a half turn, a pole) is not found by a scan and not looked for here: the directed start
sets hit those exactly.
"""

import math
from concurrent.futures import Executor

import numpy as np
import pandas as pd

from bench.engines.episode import OUTCOME
from bench.engines.run import run as run_engine
from bench.experiments.plan import Plan
from bench.experiments.rows import contender_columns, settings_of
from bench.experiments.suites import SHORT
from bench.metrics.registry import metrics_of
from bench.tables.schema import boundary_columns
from tasks.base import Start
from tasks.sphere import axes
from tasks.verdict import OUTCOMES, SETTLED

SCAN = np.radians(np.arange(2.5, 178.0, 2.5))
BISECTIONS = 16
"""2.5 degrees halved 16 times: 7e-7 rad, finer than any use of it."""


def run(plan: Plan, pool: Executor | None = None) -> pd.DataFrame:
    """boundaries.parquet of a plan: one row for each of the paper's laws, or the user's, and axis.

    Args:
        pool: does a law in each of its threads; without one they take turns.
    """
    directions = axes(plan.boundary_axes)
    laws = [one for one in plan.laws if plan.boundary_axes and not one.is_beyond_the_paper]
    frames = list((pool.map if pool else map)(lambda one: _boundary(plan, one, directions), laws))
    names = [column.name for column in boundary_columns()]
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=names)


def _boundary(plan: Plan, one, directions: np.ndarray) -> pd.DataFrame:
    count = len(directions)
    first = np.full(count, len(SCAN))
    outcome = np.full(count, SETTLED)
    for place, angle in enumerate(SCAN):
        searching = np.flatnonzero(first == len(SCAN))
        if not len(searching):
            break
        codes = _outcomes(plan, one, directions[searching], np.full(len(searching), angle))
        failed = searching[codes != SETTLED]
        first[failed], outcome[failed] = place, codes[codes != SETTLED]
    settled = np.where(first > 0, SCAN[np.minimum(first, len(SCAN)) - 1], 0.0)
    fails = np.where(first < len(SCAN), SCAN[np.minimum(first, len(SCAN) - 1)], np.nan)
    found = np.flatnonzero(first < len(SCAN))
    for _ in range(BISECTIONS if len(found) else 0):
        middle = 0.5 * (settled[found] + fails[found])
        codes = _outcomes(plan, one, directions[found], middle)
        good = codes == SETTLED
        settled[found[good]] = middle[good]
        fails[found[~good]], outcome[found[~good]] = middle[~good], codes[~good]
    return pd.DataFrame(
        {
            **contender_columns(one),
            **{f"axis_{axis}": directions[:, i] for i, axis in enumerate("xyz")},
            "settled_to_rad": settled,
            "fails_from_rad": fails,
            "outcome": [OUTCOMES[code] if code != SETTLED else "" for code in outcome],
        }
    )


def _outcomes(plan: Plan, one, directions: np.ndarray, angles: np.ndarray) -> np.ndarray:
    starts = [
        Start("", (math.cos(angle / 2), *(math.sin(angle / 2) * axis).tolist()))
        for axis, angle in zip(directions, angles, strict=True)
    ]
    rows = run_engine("ideal-rk4", one, "free-body", starts, settings_of(plan, SHORT), metrics_of(on_arm=False))
    return rows[:, OUTCOME].astype(int)
