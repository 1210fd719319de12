"""Episodes as curves: the state every few ticks, for figures and for claims about a whole response."""

import itertools

import numpy as np
import pandas as pd
import pyarrow as pa

import tasks
from bench.discovery import metrics_of
from bench.engines import run_arm
from bench.engines.curve import ARM_NUMBERS, NUMBERS, blank_curves
from bench.engines.run import run_compiled
from bench.plan import Plan
from bench.rows import contender_columns, settings_of
from bench.schema import trace_columns
from bench.store import as_table, joined

EVERY_S = 0.02
"""Five samples in each time constant of 0.1 s."""

LONGEST_S = 4.0
SAMPLES = round(LONGEST_S / EVERY_S)

ARM_SETS = ("clear", "pole")
"""Start sets of arms whose first episodes are kept."""


def run(plan: Plan) -> pa.Table:
    """traces.parquet of a plan.

    On the ideal plant, of the paper's laws and the user's, the `paper` starts and the first `plan.traces` uniform ones;
    on arms the first `plan.arm_traces` of each of ARM_SETS. A table of arrow's, joined from one for each law and set of
    starts: as one data frame it took five times the memory, and a table for each curve took 65 kB beside its numbers.
    """
    every = max(1, round(EVERY_S / plan.dt_s))
    names = [column.name for column in trace_columns()]
    frames = itertools.chain(_on_free_body(plan, every), _on_arms(plan, every))
    tables = [as_table(frame.reindex(columns=names), "traces") for frame in frames]
    return joined(tables) if tables else as_table(pd.DataFrame(columns=names), "traces")


def _on_free_body(plan: Plan, every: int):
    metrics = metrics_of(on_arm=False)
    for one in (law for law in plan.laws if plan.traces and not law.is_beyond_the_paper):
        for start_set, count in (("paper", None), ("uniform", plan.traces)):
            starts = tasks.start_set(start_set, count, plan.seed)
            curves = blank_curves(len(starts), SAMPLES, every)
            run_compiled("ideal-rk4", one, "free-body", starts, settings_of(plan, LONGEST_S), metrics, curves)
            place = {"task": "free-body", "arm": "", **contender_columns(one), "engine": "ideal-rk4"}
            yield _frame({**place, "start_set": start_set}, starts, curves.samples, NUMBERS)


def _on_arms(plan: Plan, every: int):
    if not plan.arm_traces:
        return
    metrics, settings = metrics_of(on_arm=True), settings_of(plan, LONGEST_S)
    for task, arm, name in dict.fromkeys((unit.task, unit.arm, unit.contender) for unit in plan.units if unit.arm):
        one = plan.contender(name)
        for start_set in ARM_SETS:
            starts = tasks.start_set(start_set, plan.arm_traces, plan.seed, arm=arm)
            curves = blank_curves(len(starts), SAMPLES, every, ARM_NUMBERS)
            run_arm.run_native(one, task, arm, starts, settings, metrics, curves, plan.integrator)
            place = {"task": task, "arm": arm, **contender_columns(one), "engine": "native", "start_set": start_set}
            yield _frame(place, starts, curves.samples, ARM_NUMBERS)


def _frame(place: dict, starts, samples: np.ndarray, names: tuple[str, ...]) -> pd.DataFrame:
    """The curves of all starts, one below the other."""
    is_kept = ~np.isnan(samples[:, :, 0])
    columns = dict(zip(names, samples[is_kept].T, strict=True))
    columns["angle_rad"] = 2.0 * np.arcsin(np.minimum(1.0, np.sqrt(columns.pop("haversine"))))
    ids = np.repeat([start.id for start in starts], is_kept.sum(axis=1))
    return pd.DataFrame({**place, "start_id": ids, **columns})
