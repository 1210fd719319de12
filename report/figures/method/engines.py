"""Compare engines on the same starts: how much later or earlier each law settles than on the continuous plant."""

from __future__ import annotations

import pandas as pd

KEY = ["contender", "start_set", "start_id"]
CONTINUOUS = "ideal-rk4"


def later_ms(episodes: pd.DataFrame, other: str) -> pd.Series:
    """Law -> mean of how much later it settles on another engine than on the continuous plant [ms].

    Over uniform starts that settle on both.
    """
    uniform = episodes[episodes["start_set"] == "uniform"]
    times = uniform.pivot_table(index=KEY, columns="engine", values="settling_time_s", observed=True)
    return 1e3 * (times[other] - times[CONTINUOUS]).groupby("contender", observed=True).mean()


def agreement(episodes: pd.DataFrame, one: str, other: str) -> tuple[int, int]:
    """How many episodes both engines ran, and in how many of them all judged numbers are equal bit for bit."""
    judged = [
        "outcome",
        "settling_time_s",
        "failure_time_s",
        "final_angle_rad",
        "effort",
        "path_ratio",
        "peak_u",
        "ticks",
    ]
    first, second = (episodes[episodes["engine"] == engine].set_index(KEY)[judged] for engine in (one, other))
    both = first.index.intersection(second.index)
    first, second = first.loc[both].astype({"outcome": str}), second.loc[both].astype({"outcome": str})
    equal = (first == second) | (first.isna() & second.isna())
    return len(both), int(equal.all(axis=1).sum())
