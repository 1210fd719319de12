"""The timings as a table for the eye: a line a law."""

import math
from pathlib import Path

import pandas as pd

from bench.timing.rows import read
from bench.timing.things import ENGINE, ENGINES, LOOP, ROLLOUT

ALONE, TO_KERNEL, TO_ROLLOUT = "alone [ns]", "alone / kernel", "native / rollout"
NOT_TIMED = "fails"


def table(timings: Path | pd.DataFrame) -> pd.DataFrame:
    """All columns are text: ns a tick alone and in each engine, and ratios with their intervals.

    Two lines are of no law: the empty loop, which the time of every law alone holds, and mujoco.rollout.

    Args:
        timings: a machine's file, or its rows.
    """
    rows = timings if isinstance(timings, pd.DataFrame) else read(timings)
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


def _name(what: str, regulator: str, representation: str) -> str:
    if not regulator:
        return "(empty loop)" if what == LOOP else "(mujoco.rollout)"
    return f"{regulator}/{representation}" if representation else regulator


def _number(ns: float) -> str:
    return f"{ns:.1f}" if math.isfinite(ns) else NOT_TIMED


def _interval(middle: float, low: float, high: float) -> str:
    return f"{middle:.3f} [{low:.3f}, {high:.3f}]" if math.isfinite(middle) else NOT_TIMED
