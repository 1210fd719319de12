"""Do laws as exported C++ do in real time what the simulated loop says? Kept in results/real-loop.

The arm is in this process, the controller in another; both share the machine with all else that runs on it, so let it
be idle. From STARTS starts an episode takes as long on the clock as it says. The limit of the gains is found by
bisection from EDGE_RAD beside the goal at home, where neither torques nor their changes are at their bounds. It is held
against theory with the delays of the other episodes. C++ needs g++ and Eigen.
"""

import functools
import itertools
import math
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import tasks
from bench.base.bisection import bisect
from bench.experiments import starts
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.suites import NOMINAL
from bench.experiments.tables.schema import RESULTS
from bench.findings.theory.late_torques import GREATEST, LAST, find_greatest_kv
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.studies.real_loop.loop import PERIOD_S, SUBSTEPS, TASK, Course, Loop, build_controller
from bench.studies.study import make_table
from tasks.base import Start, angle
from tasks.kinematics import Kinematics
from tasks.rotations import multiply
from tasks.rules import RULES
from tasks.verdict import first_watch, watched

STORED = RESULTS / "real-loop" / "real_loop.parquet"
LAWS = ("rotation-matrix", "late-braking")
STARTS, HORIZON_S = 12, 2.5
EDGE_RAD, EDGE_S, HALVINGS, REPEATS = 1e-7, 2.0, 9, 3


def settling_time(course: Course, start: Start) -> float:
    """Return the settling time [s] by the judge's rules; infinite if it has not settled."""
    band = RULES.band_haversine(angle(start.quat_wxyz, start.goal_wxyz))
    pairs = zip(course.haversine.tolist(), course.speed_squared.tolist(), strict=True)
    watch = first_watch(*next(pairs)[:1], band, course.speed_squared[0], RULES.slow_squared)
    for tick, (haversine, speed_squared) in enumerate(pairs, start=1):
        watch = watched(watch, tick, haversine, band, speed_squared, RULES.slow_squared)
    return watch.settled_since * PERIOD_S if watch.rest >= RULES.hold_ticks(PERIOD_S) else np.inf


def delays(course: Course) -> np.ndarray:
    """Return how long after each tick's state a torque that answers it or a later one came [s]."""
    ticks = np.arange(1, course.answered.max() + 1)
    return (np.searchsorted(course.answered, ticks) - (ticks - 1) * SUBSTEPS) * PERIOD_S / SUBSTEPS


def beside_home(arm: str) -> Start:
    """Return the start from rest at home, its goal EDGE_RAD away about an axis that leans to all of the base's."""
    one = tasks.arm(arm)
    quat, part = Kinematics(one).pose(one.home)[1], math.sin(0.5 * EDGE_RAD) / math.sqrt(3.0)
    goal = multiply((math.cos(0.5 * EDGE_RAD), part, part, part), quat)
    return Start("beside-home", quat, goal_wxyz=goal, q=one.home, qdot=(0.0,) * one.joints)


def is_shrinking(loop: Loop, start: Start, kv: float) -> bool:
    """Tell whether the angle is in the last part of an episode never greater than at its start."""
    course = loop.run(start, Gains(0.25 * kv * kv, kv), EDGE_S)
    return bool(course.haversine[-round(LAST * len(course.haversine)) :].max() <= course.haversine[0])


def measure(arm: str, law: str) -> list[dict[str, Any]]:
    """Return the row of an arm and a law, alone in a list."""
    some = starts.on_arm("uniform", STARTS, 0, arm)
    with (
        tempfile.TemporaryDirectory(prefix="orientation-bench-") as folder,
        Loop(arm, NOMINAL, build_controller(law, Path(folder))) as loop,
    ):
        courses = [loop.run(start, PAPERS_GAINS, HORIZON_S) for start in some]
        is_stable, most = functools.partial(is_shrinking, loop, beside_home(arm)), GREATEST / PERIOD_S
        limits = [bisect(is_stable, 0.0, most, HALVINGS)[0] for _ in range(REPEATS)]
    contender = f"{law}@geometric+{'solve' if len(some[0].q) == 6 else 'pseudo-inverse'}"
    unit = Unit("arm", contender, TASK, arm, "native", "uniform", NOMINAL, 0, STARTS, STARTS, STARTS, HORIZON_S)
    simulated = rows_of(Settings("default", dt_s=PERIOD_S), unit)["settling_time_s"].fillna(np.inf).to_numpy()
    real = np.array([settling_time(*both) for both in zip(courses, some, strict=True)])
    has_settled, both = np.isfinite(real), np.isfinite(real) & np.isfinite(simulated)
    late = np.concatenate([delays(course) for course in courses])
    predicted = [find_greatest_kv(course.answered, SUBSTEPS, PERIOD_S) for course in courses]
    row = {
        **{"arm": arm, "regulator": law, "starts": STARTS, "settled": int(has_settled.sum())},
        "simulated": int(np.isfinite(simulated).sum()),
        "agreeing": int((has_settled == np.isfinite(simulated)).sum()),
        "time_difference_s": float(np.median(np.abs(real[both] - simulated[both]))),
        "delay_median_s": float(np.median(late)),
        "delay_p99_s": float(np.quantile(late, 0.99)),
        "delay_max_s": float(late.max()),
        "kv_predicted": float(np.median(predicted)),
        **{"kv_lowest": min(predicted), "kv_highest": max(predicted), "kv_measured": float(np.median(limits))},
    }
    return [row]


def main() -> None:
    """Run the study, or go on."""
    pairs = itertools.product(tasks.arm_names(), LAWS)
    parts = {f"{arm} {law}": functools.partial(measure, arm, law) for arm, law in pairs}
    make_table("real_loop", __doc__, STORED, parts)


if __name__ == "__main__":
    main()
