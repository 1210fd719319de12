"""How linear Euler angles are under (3.7), on any arm: each is to follow E0 (1 + 10 t) exp(-10 t), at these gains."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.arms import arm_rows
from report.figures.kit.page import Run
from report.figures.responses.responses import euler_deg, gains
from tasks.paths import zyx_angles


def facts(run: Run) -> dict:
    """Gains, and how far any angle leaves its closed form; without curves in the run the gains alone."""
    episodes, traces = arm_rows.episodes(run), run.rows("traces", task="arm-regulation")
    if traces.empty:
        return gains(episodes)
    found = bends_deg(arm_rows.named(traces), episodes)
    arm, _ = found.idxmax()
    return gains(episodes) | {"bend": f"{found.max():.2g}", "bend_n": len(found), "bend_arm": arm}


def bends_deg(traces: pd.DataFrame, episodes: pd.DataFrame) -> pd.Series:
    """(arm, start) -> largest distance of an angle from its closed form [deg], of every curve from a clear start.

    Args:
        traces: of `arm_rows.named`. episodes: of `arm_rows.episodes`, for goals and gains.
    """
    keys = ["arm", "start_id"]
    own, goals = (arm_rows.of(rows, arm_rows.ON_ANGLES, start_set="clear") for rows in (traces, episodes))
    goals = goals.set_index(keys)
    found = {}
    for key, curve in own.sort_values("time_s").groupby(keys):
        goal = goals.loc[key]
        at_goal = zyx_angles(tuple(goal[[f"goal_quat_{axis}" for axis in "wxyz"]]))
        angles = euler_deg(curve) - np.degrees(at_goal)
        linear = closed_form.linear(curve["time_s"], goal["kp"], goal["kv"])[:, None]
        found[key] = float(np.abs(angles - angles[0] * linear).max())
    return pd.Series(found)
