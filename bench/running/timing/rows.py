"""From seconds to rows: results/timings/<machine>.parquet, a row for everything timed; and pytest-benchmark's JSON."""

import json
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd

from bench.base.files import write_json
from bench.base.provenance import describe, machine_key
from bench.experiments.episode_rows import contender_columns
from bench.experiments.tables.store import read_arrow, write_table
from bench.law.contender import Contender
from bench.running.timing import threads
from bench.running.timing.benchmark import DM_CONTROL, KERNEL, ROLLOUT, THREADS, Benchmark
from bench.running.timing.benchmarks import benchmarks
from bench.running.timing.ratios import Ratio, ratio
from bench.running.timing.session import TIMER, measure

PASSES, QUICK_PASSES = 31, 7
"""Odd, so that the median is a value. The interval covers the 10th to 22nd of 31, and all 7."""


def run(
    contenders: list[Contender],
    folder: Path,
    quick: bool = False,
    report: Callable = lambda _: None,
    arms: tuple[str, ...] = (),
    json_file: str = "",
) -> Path:
    """Time everything and write the machine's file.

    Args:
        arms: names of those that are timed too; and if there are any, two threads against one.
        report: called with a `benchmarks.Progress` for every law compiled and after every sample.
        json_file: gets the samples too, in pytest-benchmark's format.
    Errors:
        BadLaw: a user's law that cannot be compiled. BadResults: the folder or the file cannot be written.
    """
    measured = benchmarks(contenders, report, arms)
    seconds = measure(measured, QUICK_PASSES if quick else PASSES, report=report)
    rows = frame(measured, seconds)
    if arms:
        scaling = threads.measure(threads.QUICK_REPETITIONS if quick else threads.REPETITIONS)
        rows = pd.concat([rows, pd.DataFrame([_threads_row(scaling)])], ignore_index=True)
    path = Path(folder) / f"{machine_key()}.parquet"
    about = {**describe(), "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "quick": quick}
    write_table(path, rows, "timings", about)
    if json_file:
        write_json_of_pytest_benchmark(Path(json_file), measured, seconds)
    return path


def frame(measured: list[Benchmark], seconds: np.ndarray) -> pd.DataFrame:
    """Return the rows of timings.parquet.

    Args:
        seconds: one row a pass, one column a benchmark.
    """
    ticks = np.array([float(one.ticks) if one.ticks else np.nan for one in measured])
    ns = seconds / ticks * 1e9
    columns = list(zip(measured, ns.T, strict=True))
    kernel = next(times for one, times in columns if one.what == KERNEL)
    rollouts = {one.arm: times for one, times in columns if one.engine == ROLLOUT}
    compiled = {(one.arm, one.contender): times for one, times in columns if one.engine == "native"}
    rows = []
    for one, times in columns:
        if one.what != KERNEL:
            open_loop = ratio(times, rollouts[one.arm]) if one.engine in ("native", DM_CONTROL) else NO_RATIO
            faster = ratio(times, compiled[one.arm, one.contender]) if one.engine == DM_CONTROL else NO_RATIO
            rows.append(_row(one, times, kernel, open_loop, faster, len(ns)))
    return pd.DataFrame(rows)


NO_RATIO = Ratio(np.nan, np.nan, np.nan)
NO_LAW = {"regulator": "", "representation": "", "jacobian": "", "inverse": ""}


def _row(one: Benchmark, times: np.ndarray, kernel: np.ndarray, open_loop: Ratio, faster: Ratio, passes: int) -> dict:
    return {
        "what": one.what,
        "arm": one.arm,
        **(contender_columns(one.contender) if one.contender else NO_LAW),
        "engine": one.engine,
        "ns_per_tick": float(np.median(times)),
        "ns_reference_kernel": float(np.median(kernel)),
        **_numbers("ratio", ratio(times, kernel)),
        **_numbers("ratio_rollout", open_loop),
        **_numbers("speedup", faster),
        "passes": passes,
        "ticks": one.ticks,
    }


def _threads_row(scaling: threads.Scaling) -> dict:
    one = Benchmark(THREADS, scaling.contender, "native", scaling.ticks, print, scaling.arm)
    nothing, times = np.full(1, np.nan), np.full(1, scaling.ns_per_tick)
    return _row(one, times, nothing, NO_RATIO, scaling.speedup, scaling.repetitions)


def _numbers(name: str, of: Ratio) -> dict:
    return {name: of.median, f"{name}_low": of.low, f"{name}_high": of.high}


def read(path: Path) -> pd.DataFrame:
    """Return the rows of a machine's file.

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


OPTIONS = {"timer": TIMER, "disable_gc": True}


def write_json_of_pytest_benchmark(path: Path, measured: list[Benchmark], seconds: np.ndarray) -> None:
    """Write the samples of a run as pytest-benchmark's own JSON, without what cannot be timed.

    pytest-benchmark itself saw each pass of each benchmark as a test of its own. Here a benchmark is one, its rounds
    are the passes, and its iterations are ticks, so that every time is seconds a tick. Compare files of one machine,
    and with an eye on the reference kernel: they have no ratios.

    Args:
        seconds: one row a pass, one column a benchmark.
    Errors:
        BadResults: the file cannot be written.
    """
    from pytest_benchmark import plugin, stats, utils

    nothing: dict = dict.fromkeys(("param", "params", "cprofile_stats", "has_error"))
    kept = []
    for one, times in zip(measured, seconds.T.tolist(), strict=True):
        if one.ticks:
            group = one._replace(contender=None).name
            named = SimpleNamespace(name=one.name, fullname=one.name, group=group, extra_info={}, **nothing)
            kept.append(stats.Metadata(named, one.ticks, OPTIONS))
            for time in times:
                kept[-1].update(time)
    about = plugin.pytest_benchmark_generate_machine_info(), utils.get_commit_info()
    write_json(path, plugin.pytest_benchmark_generate_json(None, kept, True, *about))
