"""Rows that the process of a user's law gave back, checked before they count.

A law shares its process with the engine and can change what that answers. It can lie about its own rows; it cannot
write another's, leave some out, or give any that would stop the run when they are read.
"""

import numpy as np
import pandas as pd

from bench.experiments.columns import Table
from bench.experiments.experiment import Unit, experiment_of, no_rows
from bench.experiments.request import Request
from bench.experiments.tables.store import lost_table
from tasks.cause import CAUSES
from tasks.verdict import CRASHED, OUTCOMES, SETTLED

MOST_ROWS = 20_000
"""Rows of a unit that has no episodes: the curves of the suite `full` are 15,000."""

WORDS = {
    "outcome": OUTCOMES,
    "outcome_beside": OUTCOMES,
    "cause": CAUSES,
    "converged": ("yes", "no"),
}
"""Columns of words -> those that a row may have, or none."""

BY_THE_LAW = ("kp", "kv", "step_s", "converged")
"""What stands before the outcome in a row of an episode and is not known before it is run: a law may
have gains for a peak of its own, and the ideal plant shortens its step."""


def most_rows(unit: Unit) -> int:
    """Return how many rows a unit may have."""
    return MOST_ROWS if experiment_of(unit).lost is no_rows else unit.episodes


def check_rows(request: Request, unit: Unit, rows: pd.DataFrame) -> None:
    """Raise ValueError for rows that are not the unit's.

    They are of another law or start, twice or too few, or have an unknown word.
    """
    experiment = experiment_of(unit)
    words = request.contender(unit.contender).words | {
        "suite": request.suite,
        "seed": request.seed,
        "task": unit.task,
        "arm": unit.arm,
        "engine": unit.engine,
    }
    for name, value in words.items():
        if name not in rows:
            continue
        others = rows.loc[rows[name] != value, name]
        if len(others):
            raise ValueError(f"a row says {name} {others.iloc[0]!r}, not {value!r}")
    names = list(experiment.table.key)
    key = rows[names]
    if key.isna().any(axis=None) or key.duplicated().any():
        raise ValueError(f"two rows have the same {', '.join(names)}, or a row lacks one of them")
    for name, allowed in WORDS.items():
        if name in rows and not rows[name].isin(("", *allowed)).all():
            raise ValueError(f"a row has no known word in {name}")
    if experiment.lost is not no_rows:
        lost = lost_table(request, unit, OUTCOMES[CRASHED])
        _check_known(rows, lost.to_pandas(), experiment.table)
    if not experiment.is_whole(request, unit, rows):
        raise ValueError(f"{len(rows)} rows are not all of those that {unit.experiment} has")


def _check_known(rows: pd.DataFrame, wanted: pd.DataFrame, table: Table) -> None:
    """Compare what is known of each episode before it is run, as rows of a lost unit have it.

    Of a perturbation, at the levels that are there.
    """
    if "level" in rows:
        wanted = wanted[wanted["level"].isin(rows["level"])]
    if len(rows) != len(wanted):
        raise ValueError(f"it has {len(rows)} rows of {len(wanted)}")
    before_outcome = table.names[: table.names.index("outcome")]
    for name in before_outcome:
        if name in BY_THE_LAW:
            continue
        is_number = pd.api.types.is_numeric_dtype(wanted[name])
        kind = float if is_number else object
        values = rows[name].to_numpy(kind)
        if not np.array_equal(values, wanted[name].to_numpy(kind), equal_nan=is_number):
            raise ValueError(f"its rows say another {name} than their starts have")
    has_settled = rows["outcome"] == OUTCOMES[SETTLED]
    measured = rows.loc[has_settled, ["settling_time_s", "final_angle_rad"]]
    if measured.isna().any(axis=None) or (rows["outcome"] == "").any():
        raise ValueError("a row has no outcome, or one that settled no time")
