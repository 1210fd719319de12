"""Time every law, engine and arm on this machine: the rows of results/timings/<machine>.parquet.

The same code timed twice on a shared machine differs by half and more; a ratio to something timed a
moment before does not. So the reference kernel is timed before each round of a benchmark, and a
ratio is taken within a round. All is timed in several processes, one after the other, each in
another random order: a disturbance that lasts for seconds meets other benchmarks in each of them,
and places in memory differ, too. The value is the median over processes, its interval reaches from
the lowest to the highest end of theirs.
"""

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bench.base.errors import BadLaw
from bench.base.provenance import ROOT, describe, machine_key
from bench.experiments.columns import CONTENDER_KEY
from bench.experiments.tables import store
from bench.experiments.tables.run import with_contender
from bench.law.contender import Contender
from bench.regression.timer import (
    BENCHMARKS,
    ENGINES_FILE,
    LAWS_FILE,
    Progress,
    Side,
    SideFailed,
    run_benchmarks,
)

FAILS = "fails"
EMPTY = "(empty loop)"
KERNEL = "reference-kernel"
KINDS = ("law", "engine", "loop", "controller")
"""What is timed, in the order of the table."""

PROCESSES = 3
ROUNDS = 21
QUICK_ROUNDS = 7
"""Odd, so that the median is a value; its interval covers the 6th to the 16th of 21, and all 7."""

NUMBERS = ("ns_per_tick", "ns_reference_kernel", "ratio", "ratio_low", "ratio_high")


def time_laws(
    contenders: list[Contender],
    folder: Path,
    quick: bool = False,
    report: Callable[[Progress], None] = lambda _: None,
    arms: tuple[str, ...] = (),
) -> Path:
    """Time laws alone, in each engine and on these arms; return the machine's file that it writes.

    quick: in one process and few rounds. report: is called with each benchmark that has ended.

    Errors:
        BadLaw: a user's law cannot be compiled, ends its process or does not return.
    """
    files = list_files(contenders)
    names = tuple(law.name for law in contenders)
    benchmarks = (BENCHMARKS,) if arms else (LAWS_FILE, ENGINES_FILE)
    side = Side(ROOT, laws=files, names=names, benchmarks=tuple(map(str, benchmarks)))
    processes, rounds = PROCESSES, ROUNDS
    if quick:
        processes, rounds = 1, QUICK_ROUNDS
    saved = []
    for number in range(processes):

        def say(progress: Progress, number: int = number) -> None:
            done = number * progress.total + progress.done
            report(Progress(progress.name, done, processes * progress.total))

        options = [f"--shuffle={number}"]
        options += [f"--arm={arm}" for arm in arms]
        try:
            saved += run_benchmarks([side], tuple(options), rounds, say)
        except SideFailed as error:
            if not files:
                raise
            words = ", ".join(map(str, files))
            raise BadLaw(f"--law {words}: {error}; correct the file") from error
    path = Path(folder) / f"{machine_key()}.parquet"
    about = describe()
    about["date"] = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    about["quick"] = quick
    store.write_table(path, tabulate(saved, contenders), "timings", about)
    return path


def list_files(contenders: list[Contender]) -> tuple[Path, ...]:
    """Return the files of the users' laws among contenders."""
    origins = {law.regulator.origin for law in contenders}
    return tuple(Path(origin) for origin in sorted(origins) if origin)


def tabulate(saved: list[dict[str, Any]], contenders: list[Contender]) -> pd.DataFrame:
    """Return the rows of the table, laws in the order of contenders; saved: a file a process."""
    groups: dict[tuple, list[dict[str, Any]]] = {}
    for file in saved:
        for benchmark in file["benchmarks"]:
            subject = identify(benchmark["extra_info"])
            groups.setdefault(subject, []).append(benchmark)
        for failing in file["not_timed"]:
            groups.setdefault(identify(failing), [])
    names = [law.on_free_body for law in contenders]
    rows = []
    for subject, benchmarks in groups.items():
        row = dict(subject)
        if row["what"] != KERNEL:
            rows.append(row | summarize(benchmarks))
    # The processes timed in random orders.
    rows.sort(key=lambda row: find_place(row, names))
    return pd.DataFrame(rows)


def identify(subject: dict[str, Any]) -> tuple[tuple[str, str], ...]:
    """Return what was timed, as names and values of the columns of the table's key."""
    words = dict.fromkeys(CONTENDER_KEY, "")
    words |= subject["contender"]
    row = {
        "what": subject["what"],
        "arm": subject["arm"],
        **words,
        "engine": subject["engine"],
    }
    return tuple(row.items())


def find_place(row: dict[str, Any], names: list[str]) -> tuple:
    """Return by what a row is sorted; names: of the laws, in their order."""
    law = row["regulator"]
    if row["representation"]:
        law = f"{law}/{row['representation']}"
    place = len(names)
    if law in names:
        place = names.index(law)
    return (
        KINDS.index(row["what"]),
        row["arm"],
        row["engine"],
        place,
        row["jacobian"],
        row["inverse"],
    )


def summarize(benchmarks: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the numbers of a row, of one benchmark in each process; NaN if none timed it."""
    if not benchmarks:
        row = dict.fromkeys(NUMBERS, math.nan)
        return row | {"passes": 0, "ticks": 0}
    infos = [benchmark["extra_info"] for benchmark in benchmarks]
    seconds = [benchmark["stats"]["median"] for benchmark in benchmarks]
    kernel_ns = [info["kernel_ns"] for info in infos]
    steps = np.array([info["kernel_steps"] for info in infos])
    ratio, low, high = steps.T
    ticks = infos[0]["ticks"]
    tick_s = np.median(seconds) / ticks
    return {
        "ns_per_tick": float(1e9 * tick_s),
        "ns_reference_kernel": float(np.median(kernel_ns)),
        "ratio": float(np.median(ratio)),
        "ratio_low": float(low.min()),
        "ratio_high": float(high.max()),
        "passes": sum(benchmark["stats"]["rounds"] for benchmark in benchmarks),
        "ticks": ticks,
    }


def read(path: Path) -> pd.DataFrame:
    """Return the rows of a machine's file; BadResults: missing, truncated, or of another schema."""
    return store.frame(path, table="timings")


def tables(timings: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield each arm, empty for the free body, and its table: ns a tick, and over the kernel's."""
    named = with_contender(timings)
    for arm, rows in named.groupby("arm", observed=True, sort=False):
        lines: dict[str, dict[str, str]] = {}
        for row in rows.itertuples():
            name = str(row.contender) if row.regulator else EMPTY
            line = lines.setdefault(name, {"law": name})
            tick_ns = FAILS
            kernel_steps = FAILS
            if math.isfinite(row.ns_per_tick):
                tick_ns = f"{row.ns_per_tick:.1f}"
                kernel_steps = f"{row.ratio:.3f} [{row.ratio_low:.3f}, {row.ratio_high:.3f}]"
            where = row.engine or "alone"
            line[f"{where} [ns]"] = tick_ns
            if not row.engine:
                line["alone / kernel"] = kernel_steps
        table = pd.DataFrame(list(lines.values()))
        yield str(arm), table.fillna("")
