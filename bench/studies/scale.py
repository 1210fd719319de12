"""What a study of many episodes costs, and that its rows do not depend on who carries it out: results/scale/scale.json.

    python -m bench.studies.scale                     all of it: some ten minutes on an idle machine
    python -m bench.studies.scale --only schedulers   one part anew; the others stay as they are
    python -m bench.studies.scale --most 10000 --out /tmp/scale.json    a try of it

Each run is a process of its own, on one law on the ideal plant. It first runs an episode for each process, which
imports, compiles and counts; what that takes when it is repeated is taken off, so that an episode's cost is what grows
with their number.
CPU seconds hang little on what else the machine does, wall time much: the cores that others took are written beside.
"""

import argparse
import dataclasses
import hashlib
import json
import multiprocessing.process
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from bench.contenders.registry import find_contender
from bench.experiments import plan as planning
from bench.experiments.choice import Choice
from bench.experiments.plan import Plan
from bench.files import read_json, write_json
from bench.provenance import ROOT, describe
from bench.running import run
from bench.running.schedulers.words import LOCAL, THREADS

LAW = "rotation-matrix"

FEW, BASE, MANY, MOST = 1_000, 10_000, 100_000, 1_000_000
AROUND = (FEW, BASE, FEW, BASE, FEW, BASE, MANY)
ORDER = (*AROUND, MOST, *reversed(AROUND))
"""Episodes of the runs whose cost and memory are compared: small ones before the largest and after it, so that what the
machine's clock does in those minutes befalls them too."""

FIXED = 3
"""Runs of an episode for each process, whose median is taken off."""

SCHEDULERS = (THREADS, "local:1", "local:2")
"""They run MANY episodes each."""

PARTS = ("sizes", "schedulers", "killed")


def ideal(count: int, start_sets: tuple[str, ...] = ("uniform",)) -> Plan:
    """So many starts of each set of one law on the ideal plant."""
    choice = Choice((), start_sets, ("ideal-rk4",), experiments=("free-body",))
    return planning.make("default", [find_contender(LAW)], choice, count=count)


def least(scheduler: str) -> Plan:
    """An episode for each process of a scheduler, so that each begins: of sets of their own, or it were one unit."""
    processes = 1 if scheduler == THREADS else int(scheduler.removeprefix(LOCAL))
    return ideal(1, ("uniform", "half-turn")[:processes])


def mixed() -> Plan:
    """Units of every experiment, on one arm, in contact in one task and under one perturbation."""
    laws = [find_contender(name) for name in (LAW, "hybrid", "feedback-linearized/zyx-euler")]
    touching = Choice(("wrench-probe",), arms=("ur5e",), controllers=("hybrid-base+inverse",))
    alone, others = Choice(("free-body", "arm-regulation"), arms=("ur5e",)), (touching, Choice(axes=("delay",)))
    made = planning.make("quick", laws, alone, count=40)
    contact, perturbed = (planning.make("quick", laws, choice, count=8) for choice in others)
    return dataclasses.replace(made, units=(*made.units, *contact.of("contact"), *perturbed.of("robustness")))


def clocks() -> np.ndarray:
    """Seconds: CPU of this process, of those that it has seen the end of, and of the whole machine; the wall's."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    user, nice, system, _idle, _waiting, *interrupted = map(int, Path("/proc/stat").read_text().split()[1:9])
    whole = (user + nice + system + sum(interrupted)) / os.sysconf("SC_CLK_TCK")
    return np.array([*(one.ru_utime + one.ru_stime for one in both), whole, time.perf_counter()])


def spent(plan: Plan, out: Path, scheduler: str) -> np.ndarray:
    """What a run takes of each clock."""
    before = clocks()
    run.run(plan, out, workers=1, scheduler=scheduler)
    return clocks() - before


def measured(scheduler: str, count: int) -> dict:
    """A run of so many episodes in this process, and by its scheduler's: what it costs and holds.

    cpu_s: of all processes; own_cpu_s: of this one, which plans, writes and merges, and gives out work if others do it.
    others: cores that other programs took meanwhile. rows: digest of episodes.parquet.
    """
    with tempfile.TemporaryDirectory() as folder:
        _first, *again = (spent(least(scheduler), Path(folder) / str(turn), scheduler) for turn in range(1 + FIXED))
        forget_peak()
        whole = spent(ideal(count), Path(folder) / "all", scheduler)
        peak = peak_bytes()
        rows = (Path(folder) / "all" / "episodes.parquet").read_bytes()
    own, children, _, wall = whole - np.median(again, axis=0)
    return {
        "law": LAW,
        "scheduler": scheduler,
        "episodes": count,
        "cpu_s": own + children,
        "own_cpu_s": own,
        "wall_s": wall,
        "others": max(0.0, whole[2] - whole[0] - whole[1]) / whole[3],
        "peak_bytes": peak,
        "row_bytes": len(rows) / count,
        "rows": hashlib.sha256(rows).hexdigest(),
    }


def forget_peak() -> None:
    """Let Linux forget the largest memory so far, of imports and the compiler."""
    Path("/proc/self/clear_refs").write_text("5")


def peak_bytes() -> int:
    """The largest memory since then."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))


def killed() -> dict:
    """A plan by threads, by two processes, and by two of which one is killed half way: the tables' digests."""
    plan = mixed()
    half = plan.episodes() / 2
    found: dict[str, dict[str, str]] = {}
    victims: list[multiprocessing.process.BaseProcess] = []

    def kill_at_half(unit):
        told.append(unit.episodes)
        if sum(told) >= half and not victims:
            victims.append(multiprocessing.active_children()[0])
            victims[0].kill()

    for name, scheduler, hook in (
        ("threads", THREADS, lambda _: None),
        ("local:2", "local:2", lambda _: None),
        ("local:2, a worker killed", "local:2", kill_at_half),
    ):
        told: list[int] = []
        with tempfile.TemporaryDirectory() as folder:
            run.run(plan, Path(folder) / "run", workers=2, scheduler=scheduler, report=hook)
            paths = sorted((Path(folder) / "run").glob("*.parquet"))
            found[name] = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in paths}
    return {
        "units": len(plan.units),
        "killed": len(victims),
        "same": all(tables == found["threads"] for tables in found.values()),
        "tables": found,
    }


def apart(*words) -> dict:
    """What another process of this module measures."""
    asked = [sys.executable, "-m", "bench.studies.scale", *map(str, words)]
    answer = subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, check=False)
    if answer.returncode:
        raise SystemExit(answer.stderr)
    return json.loads(answer.stdout.splitlines()[-1])


def study(parts: tuple[str, ...], most: int, out: Path) -> None:
    """Measure the parts anew, each written when it is done, and keep what the file says of the others."""
    content = read_json(out) if out.is_file() else {}
    for part in parts:
        if part == "sizes":
            content[part] = [apart("--run", THREADS, count) for count in ORDER if count <= most]
        elif part == "schedulers":
            content[part] = [apart("--run", one, min(MANY, most)) for one in SCHEDULERS]
        else:
            content[part] = apart("--killed")
        about = describe()
        content.setdefault("provenance", {})[part] = {**about, "command": "python -m bench.studies.scale"}
        write_json(out, content)
        print(f"{part}: {out}", flush=True)


def main() -> None:
    """Take the words of the command line."""
    parser = argparse.ArgumentParser(prog="python -m bench.studies.scale", description=__doc__.split("\n")[0])
    parser.add_argument("--only", choices=PARTS, action="append", help="this part alone; repeatable")
    parser.add_argument("--most", type=int, default=MOST, help="no run of more episodes than this")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "scale" / "scale.json")
    parser.add_argument("--run", nargs=2, metavar=("SCHEDULER", "COUNT"), help=argparse.SUPPRESS)
    parser.add_argument("--killed", action="store_true", help=argparse.SUPPRESS)
    words = parser.parse_args()
    if words.run:
        print(json.dumps(measured(words.run[0], int(words.run[1]))))
    elif words.killed:
        print(json.dumps(killed()))
    else:
        study(tuple(words.only or PARTS), words.most, words.out)


if __name__ == "__main__":
    main()
