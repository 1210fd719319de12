"""Time every law, engine and arm on this machine (`bench time`): the rows of results/timings/<machine>.parquet.

The same code timed twice on a shared machine differs by half and more; a ratio to something timed a moment before does
not. So the reference kernel is timed before each round of a benchmark, and a ratio is taken within a round. All is
timed in several processes, one after the other, each in another random order: a disturbance that lasts for seconds
meets other benchmarks in each of them, and so does what differs from process to process, such as places in memory. The
value is the median over processes, its interval reaches from the lowest to the highest end of theirs.
"""

import json
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
from bench.experiments.tables.read import with_contender
from bench.law.contender import Contender
from bench.regression.timer import BENCHMARKS, Progress, Side, SideFailed, run_benchmarks

FAILS = "fails"
EMPTY = "(empty loop)"
KERNEL = "reference-kernel"
KINDS = ("law", "engine", "loop", "controller")
"""What is timed, in the order of the table."""

PROCESSES = 3
ROUNDS = 21
QUICK_ROUNDS = 7
"""Odd, so that the median is a value; its interval covers the 6th to the 16th of 21, and all 7."""


def time_laws(
    contenders: list[Contender],
    folder: Path,
    quick: bool = False,
    report: Callable[[Progress], None] = lambda _: None,
    arms: tuple[str, ...] = (),
) -> Path:
    """Time laws alone, in each engine and on these arms, and write the machine's file; return the file.

    quick: in one process and few rounds. report: is called with each benchmark that has ended.

    Errors:
        BadLaw: a user's law cannot be compiled, ends its process or does not return.
    """
    files = sorted({Path(law.regulator.origin) for law in contenders if law.regulator.origin})
    names = tuple(law.name for law in contenders)
    side = Side(ROOT, laws=tuple(files), names=names, benchmarks=(str(BENCHMARKS),))
    if not arms:
        without_arms = (f"{BENCHMARKS}/test_laws.py", f"{BENCHMARKS}/test_engines.py")
        side = side._replace(benchmarks=without_arms)
    processes = 1 if quick else PROCESSES
    saved = []
    for number in range(processes):

        def say(progress: Progress, number: int = number) -> None:
            done = number * progress.total + progress.done
            report(Progress(progress.name, done, processes * progress.total))

        options = (f"--shuffle={number}", *(f"--arm={arm}" for arm in arms))
        rounds = QUICK_ROUNDS if quick else ROUNDS
        try:
            saved += run_benchmarks([side], options, rounds, say)
        except SideFailed as error:
            if files:
                raise BadLaw(f"--law {', '.join(map(str, files))}: {error}; correct the file") from error
            raise
    path = Path(folder) / f"{machine_key()}.parquet"
    date = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    about = {**describe(), "date": date, "quick": quick}
    store.write_table(path, tabulate(saved, contenders), "timings", about)
    return path


def tabulate(saved: list[dict[str, Any]], contenders: list[Contender]) -> pd.DataFrame:
    """Return the rows of the table, laws in the order of contenders; saved: a file of each process."""
    groups: dict[tuple, list[dict[str, Any]]] = {}
    for file in saved:
        for benchmark in file["benchmarks"]:
            groups.setdefault(_identify(benchmark["extra_info"]), []).append(benchmark)
        for subject in file["not_timed"]:
            groups.setdefault(_identify(subject), [])
    rows = []
    for identity, benchmarks in groups.items():
        row = dict(identity)
        if row["what"] != KERNEL:
            rows.append(row | _summarize(benchmarks))
    places = {}
    for place, law in enumerate(contenders):
        places[law.words["regulator"], law.words["representation"]] = place

    def find_place(row: dict[str, Any]) -> tuple:
        law = (row["regulator"], row["representation"])
        way = (row["jacobian"], row["inverse"])
        return KINDS.index(row["what"]), row["arm"], row["engine"], places.get(law, len(places)), way

    rows.sort(key=find_place)
    return pd.DataFrame(rows)


def _identify(subject: dict[str, Any]) -> tuple:
    """Return what was timed, as the columns of the table's key."""
    words = dict.fromkeys(CONTENDER_KEY, "") | subject["contender"]
    row = {"what": subject["what"], "arm": subject["arm"], **words, "engine": subject["engine"]}
    return tuple(row.items())


def _summarize(benchmarks: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the numbers of one row, of the same benchmark in each process; NaN if it was not timed."""
    if not benchmarks:
        numbers = ("ns_per_tick", "ns_reference_kernel", "ratio", "ratio_low", "ratio_high")
        return dict.fromkeys(numbers, math.nan) | {"passes": 0, "ticks": 0}
    infos = [benchmark["extra_info"] for benchmark in benchmarks]
    ticks = infos[0]["ticks"]
    seconds = [benchmark["stats"]["median"] for benchmark in benchmarks]
    ratio, low, high = np.array([info["kernel_steps"] for info in infos]).T
    return {
        "ns_per_tick": float(1e9 * np.median(seconds) / ticks),
        "ns_reference_kernel": float(np.median([info["kernel_ns"] for info in infos])),
        "ratio": float(np.median(ratio)),
        "ratio_low": float(low.min()),
        "ratio_high": float(high.max()),
        "passes": sum(benchmark["stats"]["rounds"] for benchmark in benchmarks),
        "ticks": ticks,
    }


def read(path: Path) -> pd.DataFrame:
    """Return the rows of a machine's file; BadResults: missing, truncated, or of another schema."""
    return store.frame(path, table="timings")


def about(path: Path) -> dict[str, Any]:
    """Return commit, versions, machine and date of a machine's file; BadResults if it is none of ours."""
    metadata = store.read_arrow(path, "timings").schema.metadata
    return json.loads(metadata[b"about"])


def tables(timings: pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the arm, empty for the free body, and its table: ns a tick alone, in each engine, and over the kernel's."""
    named = with_contender(timings)
    for arm, rows in named.groupby("arm", observed=True, sort=False):
        lines: dict[str, dict[str, str]] = {}
        for row in rows.itertuples():
            name = str(row.contender) if row.regulator else EMPTY
            line = lines.setdefault(name, {"law": name})
            is_timed = math.isfinite(row.ns_per_tick)
            line[f"{row.engine or 'alone'} [ns]"] = f"{row.ns_per_tick:.1f}" if is_timed else FAILS
            if not row.engine:
                interval = f"{row.ratio:.3f} [{row.ratio_low:.3f}, {row.ratio_high:.3f}]"
                line["alone / kernel"] = interval if is_timed else FAILS
        yield str(arm), pd.DataFrame(list(lines.values())).fillna("")
