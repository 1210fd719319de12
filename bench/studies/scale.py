"""Measure what many episodes cost, on one thread and on processes: results/scale/scale.json.

    python -m bench.studies.scale                                       all of it: ten minutes on an idle machine
    python -m bench.studies.scale --most 10000 --out /tmp/scale.json    a smaller one

Each run is a process of its own, with one law on the continuous plant. It first runs an episode for each process, which
imports, compiles and counts; the time of a repetition of that is subtracted, so that what is left grows with the number
of episodes.
"""

import argparse
import functools
import hashlib
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from bench.base.files import write_json
from bench.base.provenance import ROOT, describe
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.experiments.plan import Plan
from bench.law.contenders.registry import find_contender
from bench.running import run
from bench.running.schedulers import LOCAL, THREADS
from bench.studies.study import make_parser, make_parts

LAW = "rotation-matrix"
FEW, BASE, MANY, MOST = 1_000, 10_000, 100_000, 1_000_000
AROUND = (FEW, BASE, FEW, BASE, FEW, BASE, MANY)
ORDER = (*AROUND, MOST, *reversed(AROUND))
"""Episodes of the runs whose cost and memory are compared: small ones before and after the largest, because the
machine's clock may change in these minutes."""
FIXED = 3
"""Runs of an episode for each process, whose median is subtracted."""
SCHEDULERS = (THREADS, "local:1", "local:2")
"""Each runs MANY episodes."""


def make_plan(count: int, start_sets: tuple[str, ...] = ("uniform",)) -> Plan:
    """Return a plan of that many starts of each set, of one law on the continuous plant."""
    choice = Choice((), start_sets, ("ideal-rk4",), experiments=("free-body",))
    return planning.make("default", [find_contender(LAW)], choice, count=count)


def make_smallest_plan(scheduler: str) -> Plan:
    """Return a plan with an episode for each process of a scheduler, each of its own start set: a unit each."""
    processes = 1 if scheduler == THREADS else int(scheduler.removeprefix(LOCAL))
    return make_plan(1, ("uniform", "half-turn")[:processes])


def read_clocks() -> np.ndarray:
    """Return seconds: CPU of this process and of its ended children, and wall time."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return np.array([sum(one.ru_utime + one.ru_stime for one in both), time.perf_counter()])


def time_run(plan: Plan, out: Path, scheduler: str) -> np.ndarray:
    """Run a plan and return what it took of each clock [s]."""
    before = read_clocks()
    run.run(plan, out, workers=1, scheduler=scheduler)
    return read_clocks() - before


def measure(scheduler: str, count: int) -> dict:
    """Measure a run of that many episodes in this process and its scheduler's.

    cpu_s: of all processes. peak_bytes: largest memory of this process. rows: digest of episodes.parquet.
    """
    with tempfile.TemporaryDirectory() as folder:
        smallest = make_smallest_plan(scheduler)
        _, *again = (time_run(smallest, Path(folder) / str(turn), scheduler) for turn in range(1 + FIXED))
        Path("/proc/self/clear_refs").write_text("5")  # Linux forgets the peak of imports and compiler
        whole = time_run(make_plan(count), Path(folder) / "all", scheduler)
        peak = read_peak_bytes()
        rows = (Path(folder) / "all" / "episodes.parquet").read_bytes()
    cpu, wall = whole - np.median(again, axis=0)
    return {
        "scheduler": scheduler,
        "episodes": count,
        "cpu_s": cpu,
        "wall_s": wall,
        "peak_bytes": peak,
        "rows": hashlib.sha256(rows).hexdigest(),
    }


def read_peak_bytes() -> int:
    """Return the largest memory of this process since Linux was made to forget it."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))


def measure_apart(scheduler: str, count: int) -> dict:
    """Measure a run in a process of its own."""
    command = [sys.executable, "-m", "bench.studies.scale", "--run", scheduler, str(count)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout.splitlines()[-1])


def main() -> None:
    """Run the study, or with --run one measurement of it."""
    parser = make_parser("scale", __doc__, out=ROOT / "results" / "scale" / "scale.json")
    parser.add_argument("--most", type=int, default=MOST, help="no run of more episodes than this")
    parser.add_argument("--run", nargs=2, metavar=("SCHEDULER", "COUNT"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        print(json.dumps(measure(options.run[0], int(options.run[1]))))
        return
    runs = {f"sizes {k}": (THREADS, count) for k, count in enumerate(ORDER) if count <= options.most}
    runs |= {f"schedulers {one}": (one, min(MANY, options.most)) for one in SCHEDULERS}
    made = make_parts(options.out, {name: functools.partial(measure_apart, *run) for name, run in runs.items()})
    content = {part: [row for name, row in made.items() if name.startswith(part)] for part in ("sizes", "schedulers")}
    about = describe() | {"command": "python -m bench.studies.scale"}
    write_json(options.out, {**content, "provenance": dict.fromkeys(content, about)})
    print(f"wrote {options.out}")


if __name__ == "__main__":
    main()
