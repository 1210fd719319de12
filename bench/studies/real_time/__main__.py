"""Do laws as exported C++ do in real time what the simulated loop says? Kept in results/real-time.

No arm, drive or bus is in the loop: the arm is simulated in this process, the controller runs in
another, and the delay between them is that of the operating system. Both share the machine with all
else that runs on it, so let it be idle. An episode takes as long on the clock as it says; SUBSTEPS
take turns. The limit of the gains is found by bisection from EDGE_RAD beside the goal at home,
where neither torques nor their changes are at their bounds: in real time, and in replays of
recorded delays, which are the same for all SUBSTEPS. C++ needs g++ and Eigen.

Without privileges it runs as any process does. On a machine with other work, `chrt -f 50` before
the command keeps the others from delaying it; the provenance says which it was.
"""

import functools
import itertools
import math
import os
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

import tasks
from bench.base.bisection import bisect
from bench.experiments import starts
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.request import Request
from bench.experiments.suites import NOMINAL
from bench.findings.real_time import GREATEST, HALVINGS, PERIOD_S, STUDY
from bench.findings.theory.late_torques import find_greatest_kv
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.studies.real_time.loop import (
    NEVER,
    NS,
    PERIOD_NS,
    SUBSTEPS,
    TASK,
    Course,
    Loop,
    build_programs,
)
from bench.studies.study import keep_table, make_parser, make_parts
from tasks.base import Start, angle
from tasks.kinematics import Kinematics
from tasks.rotations import multiply
from tasks.rules import RULES
from tasks.verdict import first_watch, watched

STORED = STUDY / "real_time.parquet"
LAWS = ("rotation-matrix", "late-braking")
STARTS = 12
"""Starts for an arm and a law; each runs with the next of SUBSTEPS."""
HORIZON_S = 2.5
EDGE_RAD = 1e-9
EDGE_S = 1.0
"""Length of the episodes that tell whether gains are stable."""
LAST = 0.1
"""Part of an episode, its last, in which the error of a stable loop is never that of its start."""
REPLAYED = 3
"""Episodes of an arm and a law whose delays are replayed with every number of substeps."""
POLICIES = {os.SCHED_OTHER: "SCHED_OTHER", os.SCHED_FIFO: "SCHED_FIFO", os.SCHED_RR: "SCHED_RR"}


class Episode(NamedTuple):
    """Hold an episode in real time: its start, the substeps of its arm, and its course."""

    start: Start
    substeps: int
    course: Course


def settling_time(course: Course, start: Start) -> float:
    """Return the settling time [s] by the judge's rules; infinite if it has not settled."""
    band = RULES.band_haversine(angle(start.quat_wxyz, start.goal_wxyz))
    pairs = zip(course.haversine.tolist(), course.speed_squared.tolist(), strict=True)
    watch = first_watch(*next(pairs)[:1], band, course.speed_squared[0], RULES.slow_squared)
    for tick, (haversine, speed_squared) in enumerate(pairs, start=1):
        watch = watched(watch, tick, haversine, band, speed_squared, RULES.slow_squared)
    return watch.settled_since * PERIOD_S if watch.rest >= RULES.hold_ticks(PERIOD_S) else np.inf


def compute_delays(course: Course) -> np.ndarray:
    """Return how long after each tick a torque came that answers its state or a later one [s].

    Ticks at the end that no torque answers are left out.
    """
    applied_s = course.applied_s
    never = np.where(np.isnan(applied_s), np.inf, applied_s)
    # Answers come in the order of the ticks: the least of those from a tick on is the next one.
    first_after = np.minimum.accumulate(never[::-1])[::-1]
    delays = first_after - PERIOD_S * np.arange(len(applied_s))
    return delays[np.isfinite(delays)]


def compute_parts(course: Course) -> dict[str, np.ndarray]:
    """Return the parts of the delay by both clocks [s], of the states that were answered."""
    records = course.records
    is_answered = records["applied_ns"] != NEVER
    due_ns = PERIOD_NS * np.arange(len(records))[is_answered]
    answered = records[is_answered]
    return {
        "published": NS * (answered["published_ns"] - due_ns),
        "read": NS * (answered["read_ns"] - answered["published_ns"]),
        "written": NS * (answered["written_ns"] - answered["read_ns"]),
        "noticed": NS * (answered["noticed_ns"] - answered["written_ns"]),
    }


def summarize_delays(courses: list[Course]) -> dict[str, float]:
    """Return median, 99 % and maximum of the delay and of its parts [s], by column."""
    series = {"delay": np.concatenate([compute_delays(course) for course in courses])}
    parts = [compute_parts(course) for course in courses]
    for name in parts[0]:
        series[name] = np.concatenate([part[name] for part in parts])
    columns = {}
    for name, delays in series.items():
        columns[f"{name}_median_s"] = float(np.median(delays))
        columns[f"{name}_p99_s"] = float(np.quantile(delays, 0.99))
        columns[f"{name}_max_s"] = float(delays.max())
    return columns


def beside_home(name: str) -> Start:
    """Return the start from rest at home, its goal EDGE_RAD away about a diagonal of the base."""
    arm = tasks.arm(name)
    quat = Kinematics(arm).pose(arm.home)[1]
    part = math.sin(0.5 * EDGE_RAD) / math.sqrt(3.0)
    goal = multiply((math.cos(0.5 * EDGE_RAD), part, part, part), quat)
    return Start("beside-home", quat, goal_wxyz=goal, q=arm.home, qdot=(0.0,) * arm.joints)


def critical_gains(kv: float) -> Gains:
    """Return the critically damped gains with this Kv."""
    return Gains(0.25 * kv * kv, kv)


def is_shrinking(course: Course) -> bool:
    """Tell whether the angle is in the last part of an episode never greater than at its start."""
    last = course.haversine[-round(LAST * len(course.haversine)) :]
    return bool(last.max() <= course.haversine[0])


def find_limits(loop: Loop, start: Start) -> dict[int, float]:
    """Return by substeps the greatest Kv [1/s] in real time.

    The bisections take turns, for the machine's load varies.
    """
    intervals = dict.fromkeys(SUBSTEPS, (0.0, GREATEST / PERIOD_S))
    for _, substeps in itertools.product(range(HALVINGS), SUBSTEPS):
        low, high = intervals[substeps]
        middle = 0.5 * (low + high)
        course = loop.run(start, critical_gains(middle), EDGE_S, substeps)
        intervals[substeps] = (middle, high) if is_shrinking(course) else (low, middle)
    return {substeps: low for substeps, (low, _) in intervals.items()}


def find_replayed_limit(loop: Loop, start: Start, applied_ns: np.ndarray, substeps: int) -> float:
    """Return the greatest Kv [1/s] with delays that were recorded."""

    def is_stable(kv: float) -> bool:
        return is_shrinking(loop.replay(start, critical_gains(kv), applied_ns, substeps))

    return bisect(is_stable, 0.0, GREATEST / PERIOD_S, HALVINGS)[0]


def predict(course: Course, ticks: int | None = None) -> float:
    """Return the greatest Kv [1/s] by theory with the delays of an episode or its first ticks."""
    return find_greatest_kv(course.applied_s[:ticks], PERIOD_S, GREATEST, LAST)


def simulate(arm: str, law: str, joints: int) -> np.ndarray:
    """Return the settling times [s] of the same starts in the simulated loop, without delay.

    They are infinite where it has not settled.
    """
    inverse = "solve" if joints == 6 else "pseudo-inverse"
    unit = Unit(
        "arm",
        f"{law}@geometric+{inverse}",
        TASK,
        arm,
        "native",
        "uniform",
        NOMINAL,
        first=0,
        count=STARTS,
        total=STARTS,
        episodes=STARTS,
        horizon_s=HORIZON_S,
    )
    rows = rows_of(Request("default", dt_s=PERIOD_S), unit)
    return rows["settling_time_s"].fillna(np.inf).to_numpy()


def compare_outcomes(episodes: list[Episode], simulated: np.ndarray) -> dict[str, Any]:
    """Return how many settled in real time and in the simulated loop, and how far apart."""
    real = np.array([settling_time(episode.course, episode.start) for episode in episodes])
    has_settled, should_settle = np.isfinite(real), np.isfinite(simulated)
    both = has_settled & should_settle
    difference_s = math.nan
    if both.any():
        difference_s = float(np.median(np.abs(real[both] - simulated[both])))
    return {
        "starts": len(episodes),
        "settled": int(has_settled.sum()),
        "simulated": int(should_settle.sum()),
        "agreeing": int((has_settled == should_settle).sum()),
        "time_difference_s": difference_s,
    }


def measure(arm: str, law: str) -> list[dict[str, Any]]:
    """Return a row for each number of substeps, of an arm and a law."""
    some_starts = starts.on_arm("uniform", STARTS, 0, arm)
    edge, edge_ticks = beside_home(arm), round(EDGE_S / PERIOD_S)
    simulated = simulate(arm, law, tasks.arm(arm).joints)
    with (
        tempfile.TemporaryDirectory(prefix="orientation-bench-") as folder,
        Loop(arm, NOMINAL, build_programs(law, Path(folder))) as loop,
    ):
        resolution_s = loop.resolution_s
        episodes = []
        for start, substeps in zip(some_starts, itertools.cycle(SUBSTEPS), strict=False):
            episodes.append(
                Episode(start, substeps, loop.run(start, PAPERS_GAINS, HORIZON_S, substeps))
            )
        limits = find_limits(loop, edge)
        recorded = [episode.course for episode in episodes[:REPLAYED]]
        arrivals = [course.records["applied_ns"][:edge_ticks] for course in recorded]
        replayed = {}
        for substeps in SUBSTEPS:
            replayed[substeps] = [
                find_replayed_limit(loop, edge, applied_ns, substeps) for applied_ns in arrivals
            ]
    replays_predicted = [predict(course, edge_ticks) for course in recorded]

    rows = []
    for number, substeps in enumerate(SUBSTEPS):
        own = episodes[number :: len(SUBSTEPS)]
        courses = [episode.course for episode in own]
        predicted = [predict(course) for course in courses]
        rows.append(
            {
                "arm": arm,
                "regulator": law,
                "substeps": substeps,
                **compare_outcomes(own, simulated[number :: len(SUBSTEPS)]),
                "resolution_s": resolution_s,
                **summarize_delays(courses),
                "kv_predicted": float(np.median(predicted)),
                "kv_lowest": min(predicted),
                "kv_highest": max(predicted),
                "kv_measured": limits[substeps],
                "kv_replayed": float(np.median(replayed[substeps])),
                "kv_replay_predicted": float(np.median(replays_predicted)),
            }
        )
    return rows


def describe_load() -> str:
    """Return the mean number of processes that ran or waited, of the last minute."""
    return f"{os.getloadavg()[0]:.1f} processes"


def describe_scheduling() -> str:
    """Return by which rule the operating system chooses when the two processes run."""
    policy = os.sched_getscheduler(0)
    priority = os.sched_getparam(0).sched_priority
    return f"{POLICIES.get(policy, policy)}, priority {priority}, nice {os.nice(0)}"


def parts() -> Iterator[tuple[str, Callable[[], list[dict[str, Any]]]]]:
    """Return name and measurement of each arm and law."""
    for arm, law in itertools.product(tasks.arm_names(), LAWS):
        yield f"{arm} {law}", functools.partial(measure, arm, law)


def main() -> None:
    """Run the study, or go on."""
    out = make_parser("real_time", __doc__, out=STORED).parse_args().out
    load_before = describe_load()
    made = make_parts(out, dict(parts()))
    rows = pd.DataFrame(list(itertools.chain.from_iterable(made.values())))
    scheduling = {
        "scheduling": describe_scheduling(),
        "load_before": load_before,
        "load_after": describe_load(),
    }
    keep_table("real_time", out, rows, **scheduling)


if __name__ == "__main__":
    main()
