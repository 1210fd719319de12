"""The timings as tables for the eye: a line a law, and a line a controller of an arm."""

import math
from pathlib import Path

import pandas as pd

from bench.running.timing.benchmark import DM_CONTROL, ENGINE, LOOP, ROLLOUT, THREADS
from bench.running.timing.benchmarks import ENGINES
from bench.running.timing.rows import read

ALONE, TO_KERNEL, TO_ROLLOUT = "alone [ns]", "alone / kernel", "native / rollout"
NOT_TIMED = "fails"


def table(timings: Path | pd.DataFrame) -> pd.DataFrame:
    """All columns are text: ns a tick alone and in each engine, and ratios with their intervals.

    Two lines are of no law: the empty loop, which the time of every law alone holds, and mujoco.rollout.

    Args:
        timings: a machine's file, or its rows.
    """
    rows = _rows(timings)
    rows = rows[rows["arm"] == ""]
    in_engine = {engine: f"{engine} [ns]" for engine in ENGINES}
    blank = dict.fromkeys((ALONE, TO_KERNEL, *in_engine.values(), TO_ROLLOUT), "")
    lines: dict[str, dict] = {}
    for row in rows.itertuples():
        name = _name(row.what, row.regulator, row.representation)
        line = lines.setdefault(name, {"law": name, **blank})
        if row.what == ENGINE:
            line[in_engine["native" if row.engine == ROLLOUT else row.engine]] = _number(row.ns_per_tick)
        else:
            line[ALONE] = _number(row.ns_per_tick)
            line[TO_KERNEL] = _interval(row.ratio, row.ratio_low, row.ratio_high)
        if row.engine == "native":
            line[TO_ROLLOUT] = _interval(row.ratio_rollout, row.ratio_rollout_low, row.ratio_rollout_high)
    return pd.DataFrame(list(lines.values()))


def arm_table(timings: Path | pd.DataFrame) -> pd.DataFrame:
    """All columns are text: ns a tick on every arm, over rollout's; of two lines how many times as fast.

    Those are dm_control's loop with numpy, which native is so many times as fast as, and two threads against one.

    Args:
        timings: a machine's file, or its rows.
    """
    rows = _rows(timings)
    lines = []
    for row in rows[rows["arm"] != ""].itertuples():
        law = f"{row.regulator}/{row.representation}" if row.representation else row.regulator
        said = {ROLLOUT: "(mujoco.rollout)", DM_CONTROL: f"(dm_control and numpy) {law}"}.get(row.engine, law)
        by = f"{row.jacobian}+{row.inverse}" if row.jacobian else ""
        line = {
            "arm": row.arm,
            "law": f"(two threads, wall) {law}" if row.what == THREADS else said,
            "by": by,
            "a tick [ns]": _number(row.ns_per_tick),
        }
        compared = row.engine in ("native", DM_CONTROL) and row.what != THREADS
        line["/ rollout"] = (
            _interval(row.ratio_rollout, row.ratio_rollout_low, row.ratio_rollout_high) if compared else ""
        )
        is_other = row.engine == DM_CONTROL or row.what == THREADS
        line["speed-up"] = _interval(row.speedup, row.speedup_low, row.speedup_high) if is_other else ""
        lines.append(line)
    return pd.DataFrame(lines)


def _rows(timings: Path | pd.DataFrame) -> pd.DataFrame:
    return timings if isinstance(timings, pd.DataFrame) else read(timings)


def _name(what: str, regulator: str, representation: str) -> str:
    if not regulator:
        return "(empty loop)" if what == LOOP else "(mujoco.rollout)"
    return f"{regulator}/{representation}" if representation else regulator


def _number(ns: float) -> str:
    return f"{ns:.1f}" if math.isfinite(ns) else NOT_TIMED


def _interval(middle: float, low: float, high: float) -> str:
    return f"{middle:.3f} [{low:.3f}, {high:.3f}]" if math.isfinite(middle) else NOT_TIMED
