"""Episodes as curves: the state every few ticks, for figures and for claims about a whole response.

On the free body, of every law: the `paper` starts, some uniform ones and those of TELLING. Claims measure the paper's
laws on the first two, to the last digit; every other curve is there to be drawn, to KEPT_BITS.
"""

import itertools

import numpy as np
import pandas as pd
import pyarrow as pa

import tasks
from bench.engines import run_arm
from bench.engines.curve import ARM_NUMBERS, NUMBERS, blank_curves
from bench.engines.run import run_compiled
from bench.experiments.plan import Plan
from bench.experiments.rows import contender_columns, judged_columns, settings_of
from bench.experiments.suites import HORIZON, SHORT
from bench.law.contender import Contender
from bench.metrics.registry import metrics_of
from bench.tables.schema import trace_columns
from bench.tables.store import as_table, joined

EVERY_S = 0.02
"""Five samples in each time constant of 0.1 s."""

LONGEST_S = 4.0
SAMPLES = round(LONGEST_S / EVERY_S)

KEPT_BITS = 22
"""Of a mantissa, 31 bits of it zero: half the bytes, and steps of 5e-7 that `bench compare` does not see."""

FEW = 3
"""Uniform starts of a later law."""

TELLING = {
    "half-turn": ("half-turn-random0-k02", "half-turn-random0-k04", "half-turn-random0-exact", "half-turn-x-exact"),
    "poles": ("pole-plus-k02-a2.5-g2.8", "pole-plus-exact-twist-plus-1.0"),
    "wraps": ("wrap-gamma-plus-k02-b-0.9-o-1.5",),
    "goals": ("goal-beyond-wrap-gamma-up", "goal-uniform-0000"),
    "tumbling": ("tumbling-0002", "tumbling-0006"),
}
"""Start set -> the starts at which laws part.

Short of half a turn by 0.6 and 0.006 degrees, and exactly there; beside and on a pole of Z-Y-X angles; before a jump of
gamma; a goal beyond that jump, and one far from zero; spinning at 11 and at 20 rad/s.
"""

ARM_SETS = ("clear", "pole")
"""Start sets of arms whose first episodes are kept."""


def run(plan: Plan) -> pa.Table:
    """traces.parquet of a plan.

    On the free body, continuous but for MuJoCo's own actuator, the starts above; of the paper's laws and the user's the
    first `plan.traces` uniform ones. On arms the first `plan.arm_traces` of each of ARM_SETS. A table of arrow's,
    joined from one for each law and set of starts: as one data frame it took five times the memory, and a table for
    each curve took 65 kB beside its numbers.
    """
    every = max(1, round(EVERY_S / plan.dt_s))
    names = [column.name for column in trace_columns()]
    frames = itertools.chain(_on_free_body(plan, every), _on_arms(plan, every))
    tables = [as_table(frame.reindex(columns=names), "traces") for frame in frames]
    return joined(tables) if tables else as_table(pd.DataFrame(columns=names), "traces")


def _on_free_body(plan: Plan, every: int):
    metrics = metrics_of(on_arm=False)
    for one in plan.laws if plan.traces else ():
        engine = "native" if one.regulator.in_engine else "ideal-rk4"
        place = {"task": "free-body", "arm": "", **contender_columns(one), "engine": engine}
        for start_set, starts, is_measured in _starts(plan, one):
            curves = blank_curves(len(starts), SAMPLES, every)
            settings = settings_of(plan, HORIZON.get(start_set, SHORT))
            rows = run_compiled(engine, one, "free-body", starts, settings, metrics, curves, plan.integrator)
            endings = judged_columns(rows, plan.dt_s)
            frame = _frame({**place, "start_set": start_set}, starts, curves.samples, NUMBERS, endings)
            yield frame if is_measured else _to_draw(frame)


def _starts(plan: Plan, one: Contender):
    """(start set, starts, whether claims measure the curves) of a law."""
    is_papers = not one.is_beyond_the_paper
    yield "paper", tasks.start_set("paper"), is_papers
    yield "uniform", tasks.start_set("uniform", plan.traces if is_papers else FEW, plan.seed), is_papers
    for start_set, ids in TELLING.items():
        yield start_set, [start for start in tasks.start_set(start_set, None, plan.seed) if start.id in ids], False


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
            yield _frame(place, starts, curves.samples, ARM_NUMBERS, {"outcome": [""] * len(starts)})


def _frame(place: dict, starts, samples: np.ndarray, names, endings: dict) -> pd.DataFrame:
    """The curves of all starts, one below the other; what the judge says of an episode stands at all its samples."""
    is_kept = ~np.isnan(samples[:, :, 0])
    lengths = is_kept.sum(axis=1)
    columns = dict(zip(names, samples[is_kept].T, strict=True))
    columns["angle_rad"] = 2.0 * np.arcsin(np.minimum(1.0, np.sqrt(columns.pop("haversine"))))
    said = {name: np.repeat(values, lengths) for name, values in endings.items()}
    return pd.DataFrame({**place, "start_id": np.repeat([start.id for start in starts], lengths), **columns, **said})


def _to_draw(frame: pd.DataFrame) -> pd.DataFrame:
    """The frame with its state and command to KEPT_BITS."""
    names = [*NUMBERS[1:-1], "angle_rad"]
    mantissa, exponent = np.frexp(frame[names].to_numpy())
    frame[names] = np.ldexp(np.rint(np.ldexp(mantissa, KEPT_BITS)), exponent - KEPT_BITS)
    return frame
