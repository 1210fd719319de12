"""Small experiments that claims make on arms: curves at another step, episodes from poses of a table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

import tasks
from bench.engines.metrics.registry import metrics_of
from bench.findings.claims.probes import euler_angles, euler_angles_along
from bench.findings.claims.tables import some
from bench.findings.theory.closed_form import linear
from bench.law.contender import Contender, Gains
from bench.law.contenders.registry import find_contender, inverse, jacobian
from bench.law.so3 import from_quaternion

if TYPE_CHECKING:
    import pandas as pd

TASK = "arm-regulation"
BENDS = ("bend_0", "bend_1", "bend_2")


def controller(word: str) -> Contender:
    """The contender of `law@jacobian+inverse`."""
    law, _, way = word.partition("@")
    by, _, through = way.partition("+")
    return find_contender(law)._replace(jacobian=jacobian(by), inverse=inverse(through))


def curves(word: str, arm: str, gains: Gains, dt_s: float, count: int) -> pd.DataFrame:
    """Traces of a contender from the first clear starts of an arm: the angles' departure from the closed form.

    Returns:
        a row a sample: start_id, time_s, bend_0 to bend_2 (E less E_d + (E_0 - E_d) linear(t)) [rad],
        position_error_m.
    """
    import pandas as pd

    from bench.experiments import traces
    from bench.experiments.experiment import Settings

    unit = traces.of_arm(controller(word).name, TASK, arm, count, "clear")
    frame = traces.rows(Settings(gains=gains, dt_s=dt_s), unit)
    goals = {start.id: start.goal_wxyz for start in tasks.start_set("clear", count, 0, arm=arm)}
    parts = []
    for id, curve in frame.groupby("start_id", sort=False):
        E = euler_angles_along(curve)
        E_d = np.array(euler_angles(from_quaternion(goals[str(id)])))
        expected = E_d + (E[0] - E_d) * linear(curve["time_s"], *gains)[:, None]
        part = curve[["start_id", "time_s", "position_error_m"]].copy()
        part[list(BENDS)] = E - expected
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def beside_poles(word: str, arm: str, poses: pd.DataFrame, gains: Gains) -> pd.DataFrame:
    """Episodes from rest at poses of the table, at 10^-2 from a pole or nearer, to the pose of each family at 10^-1.

    Returns:
        rows of episodes.parquet; start_id is the pose's.
    Errors:
        NoEvidence: the table has no such pose of the arm, or none of its family at 10^-1.
    """
    from bench.engines.simulate_arms import run_arm as run
    from bench.experiments.episode_rows import frame
    from bench.experiments.experiment import Settings, Unit
    from bench.experiments.suites import NOMINAL, ON_ARM
    from tasks.kinematics import kinematics

    judge = kinematics(tasks.arm(arm))
    own = poses[(poses["arm"] == arm) & (poses["pose_set"] == "pole")].drop_duplicates("pose_id")
    names = [f"q_{i + 1}" for i in range(tasks.arm(arm).joints)]
    at = {str(id): tuple(q) for id, q in zip(own["pose_id"], own[names].to_numpy().tolist(), strict=True)}
    goals = {id.removesuffix("-1e-01"): judge.pose(q)[1] for id, q in at.items() if id.endswith("-1e-01")}
    starts = [
        judge.start(id, q, goals[family])
        for id, q in at.items()
        if not id.endswith("-1e-01") and (family := id.rpartition("-1e-")[0] or id.removesuffix("-exact")) in goals
    ]
    some(starts, f"pose of {arm} beside a pole")
    one, metrics, settings = controller(word), metrics_of(on_arm=True), Settings(gains=gains)
    unit = Unit("arm", one.name, TASK, arm, "native", "pole", NOMINAL, count=len(starts), horizon_s=ON_ARM)
    numbers = run("native", one, TASK, arm, starts, settings.limits(ON_ARM), metrics)
    return frame(settings, unit, one, starts, numbers, metrics)


def largest(frame: pd.DataFrame) -> float:
    """The largest bend of any angle [rad]; infinite if one is no number."""
    bends = frame[list(BENDS)].to_numpy()
    return float(np.abs(bends).max()) if np.isfinite(bends).all() else math.inf
