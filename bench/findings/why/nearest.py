"""The laws of a run that are most like another one: in how hard they pull, and in how soon they settle."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.contenders.registry import known_regulators
from bench.findings.why.outcomes import DIRECTED
from bench.tables.statistics import quantile

PULLS = ("pull-30", "pull-90", "pull-150")
MOST = 3


def beside(field: pd.DataFrame, episodes: pd.DataFrame, run_field: pd.DataFrame, run: pd.DataFrame) -> pd.DataFrame:
    """A law and the MOST laws of a run nearest to it, a line each, from the starts that both were asked.

    Near is the pull at three angles [kp], and the median settling time as a logarithm, each by its difference.

    Args:
        field, episodes: of the law; run_field, run: of the run's laws, by the same engine, with `contender`.
    """
    own = _line(field, episodes)
    laws = []
    for name, part in run.groupby(run["contender"].astype(str), sort=False):
        regulator = known_regulators().get(str(name).partition("/")[0])
        pulls = run_field[run_field["contender"] == name]
        if regulator is not None and not regulator.control and len(pulls):
            laws.append(_line(pulls, part[part["start_id"].isin(episodes["start_id"])]))
    ordered = sorted(laws, key=lambda line: _distance(line, own))
    return pd.DataFrame([own, *ordered[:MOST]])


def _line(field: pd.DataFrame, rows: pd.DataFrame) -> dict:
    """What is shown of a law."""
    is_uniform = rows["start_set"] == "uniform"
    settles = rows["outcome"] == "settled"
    times = rows.loc[is_uniform & settles, "settling_time_s"].to_numpy()
    pull = field.set_index(field["finding"].astype(str))["value"]
    is_half = rows["start_set"] == DIRECTED
    return {
        "law": str(rows["contender"].iloc[0]),
        "uniform": f"{(settles & is_uniform).sum()}/{is_uniform.sum()}",
        DIRECTED: f"{(settles & is_half).sum()}/{is_half.sum()}",
        "median s": round(float(quantile(times, 0.5)), 3) if len(times) else np.nan,
        "peak u": round(float(rows.loc[is_uniform, "peak_u"].median()), 1),
        "effort": round(float(rows.loc[is_uniform, "effort"].median()), 1),
        **{f"{name} deg": round(float(pull.get(name, np.nan)), 3) for name in PULLS},
    }


def _distance(one: dict, other: dict) -> float:
    """How unlike two lines are; a law that never settles is far from one that does."""
    pulls = [one[f"{name} deg"] - other[f"{name} deg"] for name in PULLS]
    times = np.log(one["median s"] / other["median s"])
    return float(np.nansum(np.square(np.nan_to_num([*pulls, times], nan=10.0))))
