"""The interleaved run, its rows in results/timings/<machine>.parquet, and tables with a line a law or controller.

CPU time of the measuring thread is taken (time.thread_time), not the clock on the wall: on a shared machine that
leaves out the time in which others ran, and a progress bar's thread. No benchmark uses a second thread. A sample is two
rounds on end and counts with the fastest, for a disturbance only ever adds; the first also warms the caches.
"""

import functools
import json
import math
import random
import time
import timeit
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from bench.base.provenance import describe, machine_key
from bench.experiments.columns import CONTENDER_KEY
from bench.experiments.tables import store
from bench.experiments.tables.read import with_contender
from bench.law.contender import Contender
from bench.running.timing.benchmark import KERNEL, Benchmark
from bench.running.timing.benchmarks import Progress, benchmarks
from bench.running.timing.ratios import ratio

NOT_TIMED, EMPTY = "fails", "(empty loop)"

ROUNDS = 2

PASSES, QUICK_PASSES = 31, 7
"""Odd, so that the median is a value. The interval covers the 10th to 22nd of 31, and all 7."""


def run(
    contenders: list[Contender], folder: Path, quick: bool = False, report: Callable = lambda _: None,
    arms: tuple[str, ...] = (),
) -> Path:  # fmt: skip
    """Time everything, these arms too, and write the machine's file; `report` is called with each Progress."""
    measured = benchmarks(contenders, report, arms)
    seconds = measure(measured, QUICK_PASSES if quick else PASSES, report)
    rows = frame(measured, seconds)
    path = Path(folder) / f"{machine_key()}.parquet"
    about = {**describe(), "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "quick": quick}
    store.write_table(path, rows, "timings", about)
    return path


def order(count: int, passes: int, seed: int = 0) -> list[list[int]]:
    """Return a new shuffle of 0..count-1 for every pass."""
    shuffled = random.Random(seed)
    return [shuffled.sample(range(count), count) for _ in range(passes)]


def measure(measured: list[Benchmark], passes: int, report: Callable = lambda _: None) -> np.ndarray:
    """Return seconds of the fastest round, garbage collection off: one row a pass, one column a benchmark."""
    seconds = np.full((passes, len(measured)), np.nan)
    visits = [(number, at) for number, row in enumerate(order(len(measured), passes)) for at in row]
    for done, (number, at) in enumerate(visits, 1):
        seconds[number, at] = min(timeit.repeat(measured[at].call, timer=time.thread_time, repeat=ROUNDS, number=1))
        report(Progress(measured[at].name, done, len(visits)))
    return seconds


def frame(measured: list[Benchmark], seconds: np.ndarray) -> pd.DataFrame:
    """Return the rows of timings.parquet; seconds: one row a pass, one column a benchmark."""
    ticks = np.array([float(one.ticks) if one.ticks else np.nan for one in measured])
    ns = seconds / ticks * 1e9
    columns = list(zip(measured, ns.T, strict=True))
    kernel = next(times for one, times in columns if one.what == KERNEL)
    return pd.DataFrame([_row(one, times, kernel) for one, times in columns if one.what != KERNEL])


def _row(one: Benchmark, times: np.ndarray, kernel: np.ndarray) -> dict:
    found = ratio(times, kernel)
    return {
        "what": one.what,
        "arm": one.arm,
        **(one.contender.words if one.contender else dict.fromkeys(CONTENDER_KEY, "")),
        "engine": one.engine,
        "ns_per_tick": float(np.median(times)),
        "ns_reference_kernel": float(np.median(kernel)),
        "ratio": found.value,
        "ratio_low": found.low,
        "ratio_high": found.high,
        "passes": len(times),
        "ticks": one.ticks,
    }


read = functools.partial(store.frame, table="timings")
"""Return the rows of a machine's file; BadResults: missing, truncated, or of another schema."""


def about(path: Path) -> dict:
    """Return commit, versions, machine and date of a machine's file; BadResults if it is none of ours."""
    return json.loads(store.read_arrow(path, "timings").schema.metadata[b"about"])


def tables(timings: Path | pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the arm, empty for the free body, and its table: ns a tick alone, in each engine, and over the kernel's."""
    every = with_contender(timings if isinstance(timings, pd.DataFrame) else read(timings))
    for arm, rows in every.groupby("arm", observed=True, sort=False):
        lines: dict[str, dict[str, str]] = {}
        for row in rows.itertuples():
            name = str(row.contender) if row.regulator else EMPTY
            line = lines.setdefault(name, {"law": name})
            time = f"{row.ns_per_tick:.1f}" if math.isfinite(row.ns_per_tick) else NOT_TIMED
            line[f"{row.engine or 'alone'} [ns]"] = time
            if not row.engine:
                interval = f"{row.ratio:.3f} [{row.ratio_low:.3f}, {row.ratio_high:.3f}]"
                line["alone / kernel"] = interval if math.isfinite(row.ratio) else NOT_TIMED
        yield str(arm), pd.DataFrame(list(lines.values())).fillna("")
