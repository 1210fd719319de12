"""Episodes as curves: the state every few ticks, for figures and for claims about a whole response."""

import functools
import itertools

import numpy as np
import pandas as pd
import pyarrow as pa

import tasks
from bench.engines import ideal
from bench.engines.arm_episode import MOST, POSE
from bench.engines.binding import command_of, margin_of, memory_of
from bench.engines.episode import FIRST_METRIC, numbers, start_rows
from bench.engines.run_arm import run_observed
from bench.plan import Plan
from bench.rows import contender_columns, settings_of
from bench.scalar import kernel, sqrt
from bench.schema import trace_columns
from bench.store import as_table, joined

EVERY_S = 0.02
"""Five samples in each time constant of 0.1 s."""

LONGEST_S = 4.0
SAMPLES = round(LONGEST_S / EVERY_S)
NUMBERS = ("time_s", *(f"{c}_{x}" for c in "noa" for x in "xyz"), *(f"{v}_{x}" for v in ("omega", "u") for x in "xyz"))
WIDTH = len(NUMBERS) + 1
ON_ARM = ("position_error_m", *(f"q_{i}" for i in range(1, MOST + 1)))
ARM_WIDTH = WIDTH + len(ON_ARM)

ARM_SETS = ("clear", "pole")
"""Start sets of arms whose first episodes are kept."""


@kernel
def store(row, at, sample):
    """One sample's numbers into the row."""
    R, omega, u = sample.R, sample.omega, sample.u
    row[at] = sample.time
    for i in range(3):
        row[at + 1 + i] = R.n[i]
        row[at + 4 + i] = R.o[i]
        row[at + 7 + i] = R.a[i]
        row[at + 10 + i] = omega[i]
        row[at + 13 + i] = u[i]
    row[at + 16] = sample.haversine


@kernel
def store_joints(row, at, sample):
    """The tool's distance from its place, and the joint angles."""
    x, y, z = sample.p[0] - sample.p_d[0], sample.p[1] - sample.p_d[1], sample.p[2] - sample.p_d[2]
    row[at] = sqrt(x * x + y * y + z * z)
    for i in range(MOST):
        row[at + 1 + i] = sample.q[i]


def recorder(every: int):
    """An observer that keeps every so many ticks of the episode while its row has room."""

    @kernel
    def observe(row, sample):
        tick = int(sample.time / sample.dt + 0.5)
        at = FIRST_METRIC + tick // every * WIDTH
        if tick % every < 1 and at + WIDTH <= row.shape[0]:
            store(row, at, sample)

    return observe


@functools.cache
def arm_recorder(every: int):
    """The same of an arm; its rows end in the arm's own columns."""

    @kernel
    def observe(row, sample):
        tick = int(sample.time / sample.dt + 0.5)
        at = FIRST_METRIC + tick // every * ARM_WIDTH
        if tick % every < 1 and at + ARM_WIDTH <= row.shape[0] + POSE:
            store(row, at, sample)
            store_joints(row, at + WIDTH, sample)

    return observe


def run(plan: Plan) -> pa.Table:
    """traces.parquet of a plan.

    On the ideal plant, of the paper's laws and the user's, the `paper` starts and the first `plan.traces` uniform ones;
    on arms the first `plan.arm_traces` of each of ARM_SETS. A table of arrow's, made curve by curve: as one data frame
    it took five times the memory.
    """
    every = max(1, round(EVERY_S / plan.dt_s))
    names = [column.name for column in trace_columns()]
    curves = itertools.chain(_on_free_body(plan, every), _on_arms(plan, every))
    tables = [as_table(curve.reindex(columns=names), "traces") for curve in curves]
    return joined(tables) if tables else as_table(pd.DataFrame(columns=names), "traces")


def _on_free_body(plan: Plan, every: int):
    for one in (law for law in plan.laws if plan.traces and not law.is_beyond_the_paper):
        parts = command_of(one), margin_of(one), recorder(every), memory_of(one)
        loop = ideal.episodes_of("ideal-rk4", *parts, not one.regulator.origin)
        for start_set, count in (("paper", None), ("uniform", plan.traces)):
            starts = tasks.start_set(start_set, count, plan.seed)
            rows = np.full((len(starts), FIRST_METRIC + SAMPLES * WIDTH), np.nan)
            loop(start_rows(starts), numbers(settings_of(plan, LONGEST_S)), rows)
            place = {"task": "free-body", "arm": "", **contender_columns(one), "engine": "ideal-rk4"}
            yield from _curves({**place, "start_set": start_set}, starts, rows[:, FIRST_METRIC:], NUMBERS)


def _on_arms(plan: Plan, every: int):
    if not plan.arm_traces:
        return
    for task, arm, name in dict.fromkeys((unit.task, unit.arm, unit.contender) for unit in plan.units if unit.arm):
        one = plan.contender(name)
        for start_set in ARM_SETS:
            starts = tasks.start_set(start_set, plan.arm_traces, plan.seed, arm=arm)
            rows = np.full((len(starts), FIRST_METRIC + SAMPLES * ARM_WIDTH - POSE), np.nan)
            settings = settings_of(plan, LONGEST_S)
            run_observed(arm_recorder(every), one, task, arm, starts, settings, rows, plan.integrator)
            place = {"task": task, "arm": arm, **contender_columns(one), "engine": "native", "start_set": start_set}
            yield from _curves(place, starts, rows[:, FIRST_METRIC:POSE], (*NUMBERS, "angle", *ON_ARM))


def _curves(place: dict, starts, rows: np.ndarray, names):
    """One frame a start."""
    for start, row in zip(starts, rows, strict=True):
        kept = row.reshape(SAMPLES, -1)
        kept = kept[~np.isnan(kept[:, 0])]
        columns = {name: kept[:, i] for i, name in enumerate(names) if name != "angle"}
        columns["angle_rad"] = 2.0 * np.arcsin(np.minimum(1.0, np.sqrt(kept[:, len(NUMBERS)])))
        yield pd.DataFrame({**place, "start_id": start.id, **columns})
