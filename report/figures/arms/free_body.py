"""Settling times on arms against those of the free body, for the same law, start and goal.

The paper's claim for both of its controllers: behind them the wrist is the free body of its first chapter. The free
body runs here, in MuJoCo too, from the orientations of the arm's starts.
"""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd

from bench.engines.episode import OUTCOME, SETTLING_TICK, Settings
from bench.engines.run import run
from bench.law.contender import Gains
from bench.metrics.registry import metrics_of
from report.figures.arms import arm_rows
from tasks import Start
from tasks.rules import RULES
from tasks.verdict import SETTLED

START_SET = "clear"
CLOSE_TICKS = 5
"""Differences of so many ticks are told apart from larger ones: both plants integrate with errors of first order."""


def differences(rows: pd.DataFrame) -> pd.DataFrame:
    """Clear starts by the standard inverse: settling time on the arm, on the free body, and the difference [s]."""
    clear = rows[rows["start_set"] == START_SET]
    parts = []
    for law, own in clear.groupby("law"):
        starts = own.drop_duplicates(["arm", "start_id"])
        alone = pd.Series(_alone(law, starts), index=pd.MultiIndex.from_frame(starts[["arm", "start_id"]]))
        there = alone.reindex(pd.MultiIndex.from_frame(own[["arm", "start_id"]])).to_numpy()
        parts.append(own.assign(alone_s=there, later_s=own["settling_time_s"] - there))
    return pd.concat(parts, ignore_index=True) if parts else clear.assign(alone_s=np.nan, later_s=np.nan)


def _alone(law: str, starts: pd.DataFrame) -> list[float]:
    """Settling times of the free body from the orientations of these rows [s], NaN where it does not settle."""
    columns = [[f"{kind}_{axis}" for axis in "wxyz"] for kind in ("quat", "goal_quat")]
    columns.insert(1, [f"omega0_{axis}" for axis in "xyz"])
    places = (starts[names].itertuples(index=False, name=None) for names in columns)
    given = tuple(Start(str(i), *place) for i, place in enumerate(zip(*places, strict=True)))
    one = starts.iloc[0]
    horizon = float(starts["horizon_s"].max())
    return list(_settling_s(law, given, float(one["kp"]), float(one["kv"]), float(one["dt_s"]), horizon))


@functools.cache
def _settling_s(law: str, starts: tuple, kp: float, kv: float, dt_s: float, horizon_s: float) -> tuple[float, ...]:
    ticks = round(horizon_s / dt_s)
    settings = Settings(Gains(kp, kv), dt_s, ticks, round(RULES.hold_s / dt_s))
    found = run("native", arm_rows.contenders()[law], "free-body", starts, settings, metrics_of(on_arm=False))
    times = np.where(found[:, OUTCOME] == SETTLED, found[:, SETTLING_TICK] * dt_s, np.nan)
    return tuple(times.tolist())


def close(found: pd.DataFrame) -> pd.Series:
    """Whether an episode settles as the free body does: within CLOSE_TICKS, or neither does."""
    within = found["later_s"].abs() <= (CLOSE_TICKS + 0.5) * found["dt_s"]
    return within | (found["alone_s"].isna() & found["settling_time_s"].isna())
