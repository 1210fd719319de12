"""What rounding decides of an arm's episodes: each doubtful one is run again from 1e-12 rad away.

An arm that passes a singularity, or asks far more of its motors than they are rated for, multiplies the last bit of a
library's sine until it is an outcome. Such an episode is repeated from q + NUDGE in every joint, further than any two
libraries' roundings lead apart and nearer than any difference one could mean: where an outcome is another one there, it
is on a knife's edge, and the row says both.

Limitations: an episode that is neither DOUBTFUL in conditioning nor in torque, and hangs on rounding nevertheless, is
not seen. Under other BLAS kernels, compiler targets and C libraries' variants of sin and cos there was none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from bench.base.on_first_use import pd
from tasks.base import Start

NUDGE = 1e-12
"""[rad]. Joint angles are rounded to 4e-16; two libraries' sines and some 1e3 ticks make 1e-14 of that."""

CONDITION = 1e3
"""Condition number of J from which on an episode is doubtful: accelerations have it twice, 1e6 times rounding."""

TORQUE_RATIO = 100.0
"""Torque over its rated one, likewise: the law's own coordinates were near a singularity."""

ZERO = 1e-9
"""What is smaller in both does not count as a change: it is rounding itself."""

OUTCOME_NUDGED, ROUNDING_CHANGE = "outcome_beside", "rounding_change"
"""Columns of the tables: results that are kept have these names."""


def rerun_nudged(
    rows: pd.DataFrame, starts: Sequence[Start], simulate: Callable[[list[Start]], pd.DataFrame]
) -> pd.DataFrame:
    """Run each doubtful episode again from a start NUDGE away, and add what changed to its row.

    Args:
        rows: Rows of episodes, one a start.
        starts: Their starts.
        simulate: Function that returns the rows of other starts, simulated in the same way.

    Returns:
        The rows with two columns more. OUTCOME_NUDGED is the outcome from the nudged start if it is
        another one; it is empty if it is not, or if the episode is not doubtful. ROUNDING_CHANGE is
        the largest relative change of any number of the row; null if the episode is not doubtful.
    """
    doubtful = np.flatnonzero((rows["cond_jacobian_max"] > CONDITION) | (rows["peak_torque_ratio"] > TORQUE_RATIO))
    other, change = np.full(len(rows), "", object), np.full(len(rows), np.nan)
    if len(doubtful):
        here = rows.iloc[doubtful].reset_index(drop=True)
        there = simulate([nudged(starts[i], NUDGE) for i in doubtful.tolist()])
        differs = (there["outcome"] != here["outcome"]).to_numpy()
        other[doubtful[differs]] = there["outcome"][differs]
        change[doubtful] = _change(here, there)
    return rows.assign(**{OUTCOME_NUDGED: other, ROUNDING_CHANGE: change})


def nudged(start: Start, by: float) -> Start:
    """Return the same start and goal, every joint turned by so much [rad]."""
    return start._replace(q=tuple(angle + by for angle in start.q))


def _change(here: pd.DataFrame, there: pd.DataFrame) -> np.ndarray:
    """Return the largest relative change of a number in each row; infinite where one of them is none."""
    a, b = (frame.select_dtypes("number").to_numpy(float) for frame in (here, there))
    size = np.fmax(abs(a), abs(b))
    with np.errstate(invalid="ignore", divide="ignore"):
        changes = np.where((a == b) | (size < ZERO), 0.0, abs(a - b) / size)
    changes[np.isnan(a) & np.isnan(b)] = 0.0
    changes[np.isnan(a) != np.isnan(b)] = np.inf
    changes[np.isnan(changes)] = np.inf
    return changes.max(axis=1)
