"""From seconds to rows: results/timings/<machine>.parquet, one row for everything timed."""

import json
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd

from bench.contender import Contender
from bench.provenance import describe, machine_key
from bench.rows import contender_columns
from bench.schema import RESULTS
from bench.store import read_arrow, write_table
from bench.timing.ratios import Ratio, ratio
from bench.timing.session import measure
from bench.timing.things import KERNEL, ROLLOUT, Thing, things

FOLDER = RESULTS / "timings"
PASSES, QUICK_PASSES = 61, 7
"""Odd, so that the median is a value. The interval covers the 23rd to 39th of 61, and all 7."""


def run(
    contenders: list[Contender], folder: Path = FOLDER, quick: bool = False, told: Callable = lambda _: None
) -> Path:
    """Time everything and write the machine's file.

    Args:
        told: called with a `things.Progress` for every law compiled and after every visit.
    Errors:
        BadLaw: a user's law that cannot be compiled. BadResults: the folder cannot be written.
    """
    measured = things(contenders, told)
    seconds = measure(measured, QUICK_PASSES if quick else PASSES, told=told)
    path = Path(folder) / f"{machine_key()}.parquet"
    about = {**describe(), "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "quick": quick}
    write_table(path, frame(measured, seconds), "timings", about)
    return path


def frame(measured: list[Thing], seconds: np.ndarray) -> pd.DataFrame:
    """The rows of timings.parquet.

    Args:
        seconds: one row a pass, one column a thing.
    """
    ticks = np.array([float(one.ticks) if one.ticks else np.nan for one in measured])
    ns = seconds / ticks * 1e9
    kernel = ns[:, [one.what for one in measured].index(KERNEL)]
    rollout = ns[:, [one.engine for one in measured].index(ROLLOUT)]
    rows = []
    for one, times in zip(measured, ns.T, strict=True):
        if one.what != KERNEL:
            open_loop = ratio(times, rollout) if one.engine == "native" else Ratio(np.nan, np.nan, np.nan)
            rows.append(_row(one, times, kernel, open_loop, len(ns)))
    return pd.DataFrame(rows)


def _row(one: Thing, times: np.ndarray, kernel: np.ndarray, open_loop: Ratio, passes: int) -> dict:
    to_kernel = ratio(times, kernel)
    law = contender_columns(one.contender) if one.contender else {"regulator": "", "representation": ""}
    return {
        "what": one.what,
        "regulator": law["regulator"],
        "representation": law["representation"],
        "engine": one.engine,
        "ns_per_tick": float(np.median(times)),
        "ns_reference_kernel": float(np.median(kernel)),
        "ratio": to_kernel.median,
        "ratio_low": to_kernel.low,
        "ratio_high": to_kernel.high,
        "ratio_rollout": open_loop.median,
        "ratio_rollout_low": open_loop.low,
        "ratio_rollout_high": open_loop.high,
        "passes": passes,
        "ticks": one.ticks,
    }


def read(path: Path) -> pd.DataFrame:
    """The rows of a machine's file.

    Errors:
        BadResults: missing, truncated, or of another schema.
    """
    return read_arrow(path, "timings").to_pandas()


def about(path: Path) -> dict:
    """Commit, versions, machine and date of a machine's file.

    Errors:
        BadResults: missing, truncated, or of another schema.
    """
    return json.loads(read_arrow(path, "timings").schema.metadata[b"about"])
