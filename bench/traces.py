"""Episodes as curves: the state every few ticks, for figures and for claims about a whole response."""

import numpy as np
import pandas as pd

import tasks
from bench.engines import ideal
from bench.engines.binding import command_of, margin_of, memory_of
from bench.engines.episode import FIRST_METRIC, numbers, start_rows
from bench.plan import Plan
from bench.rows import contender_columns, settings_of
from bench.scalar import kernel
from bench.schema import trace_columns

EVERY_S = 0.02
"""Five samples in each time constant of 0.1 s."""

LONGEST_S = 4.0
NUMBERS = ("time_s", *(f"{c}_{x}" for c in "noa" for x in "xyz"), *(f"{v}_{x}" for v in ("omega", "u") for x in "xyz"))
WIDTH = len(NUMBERS) + 1


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


def recorder(every: int):
    """An observer that keeps every so many ticks of the episode while its row has room."""

    @kernel
    def observe(row, sample):
        tick = int(sample.time / sample.dt + 0.5)
        at = FIRST_METRIC + tick // every * WIDTH
        if tick % every < 1 and at + WIDTH <= row.shape[0]:
            store(row, at, sample)

    return observe


def run(plan: Plan) -> pd.DataFrame:
    """traces.parquet of a plan: the `paper` starts and the first `plan.traces` uniform ones, on the ideal plant."""
    frames = []
    if plan.traces:
        every = max(1, round(EVERY_S / plan.dt_s))
        for one in plan.contenders:
            parts = command_of(one), margin_of(one), recorder(every), memory_of(one)
            loop = ideal.episodes_of("ideal-rk4", *parts, not one.regulator.origin)
            for start_set, count in (("paper", None), ("uniform", plan.traces)):
                frames += _traces(plan, one, loop, start_set, tasks.start_set(start_set, count, plan.seed))
    names = [column.name for column in trace_columns()]
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame(columns=names)


def _traces(plan, one, loop, start_set, starts):
    samples = round(LONGEST_S / EVERY_S)
    rows = np.full((len(starts), FIRST_METRIC + samples * WIDTH), np.nan)
    loop(start_rows(starts), numbers(settings_of(plan, LONGEST_S)), rows)
    for start, row in zip(starts, rows, strict=True):
        kept = row[FIRST_METRIC:].reshape(samples, WIDTH)
        kept = kept[~np.isnan(kept[:, 0])]
        columns = dict(zip(NUMBERS, kept.T, strict=False))
        columns["angle_rad"] = 2.0 * np.arcsin(np.minimum(1.0, np.sqrt(kept[:, -1])))
        fixed = {**contender_columns(one), "engine": "ideal-rk4", "start_set": start_set, "start_id": start.id}
        yield pd.DataFrame({**fixed, **columns})
