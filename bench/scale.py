"""What a study of many episodes costs, and that its rows do not hang on who carries it out: results/scale/scale.json.

    python -m bench.scale                     all of it: some ten minutes on an idle machine
    python -m bench.scale --only schedulers   one part anew; the others stay as they are

Each run is a process of its own, on one law on the ideal plant. It first runs a single episode, which imports, compiles
and counts; what that takes when it is repeated is taken off, so that an episode's cost is what grows with their number.
Seconds of CPU do not hang on what else the machine does, wall time does: the load is written beside it.
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

from bench import finish, run
from bench import plan as planning
from bench.choice import Choice
from bench.contender import Contender, Regulator
from bench.discovery import find_contender
from bench.plan import Plan
from bench.provenance import ROOT, describe
from bench.schedulers.words import THREADS
from bench.store import read_json, write_json

LAW = "rotation-matrix"
SIZES = (1_000, 10_000, 100_000, 1_000_000)
"""Episodes whose cost and memory are compared."""

SHARED = 100_000
"""Episodes that one thread, one process and two processes run."""

SCHEDULERS = (THREADS, "local:1", "local:2")
PARTS = ("sizes", "schedulers", "killed")


def ideal(count: int) -> Plan:
    """So many uniform starts of one law on the ideal plant."""
    return planning.make("default", [find_contender(LAW)], Choice((), ("uniform",), ("ideal-rk4",)), count=count)


def mixed() -> Plan:
    """Units of every kind: on the free body, on an arm, in contact and in trouble."""
    laws = [find_contender(name) for name in (LAW, "hybrid", "feedback-linearized/zyx-euler")]
    touching = Choice(("wrench-probe",), arms=("ur5e",), controllers=("hybrid-base+inverse",))
    alone, others = Choice(("free-body", "arm-regulation"), arms=("ur5e",)), (touching, Choice(axes=("delay",)))
    made = planning.make("quick", laws, alone, count=40)
    contact, trouble = (planning.make("quick", laws, choice, count=8) for choice in others)
    return dataclasses.replace(made, contacts=contact.contacts, troubles=trouble.troubles, traces=0, poses=0)


def one_law(extra: tuple[Regulator, ...] = ()) -> list[Contender]:
    """The law of the study, in the place of all."""
    return [find_contender(LAW)]


def cpu_s() -> float:
    """Seconds of CPU of this process and of those that it has seen the end of."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in both)


def measured(scheduler: str, count: int) -> dict:
    """A run of so many episodes in this process, and by its scheduler's: what it costs and holds."""
    finish.all_contenders = one_law  # counting the others takes ten seconds whatever the number
    with tempfile.TemporaryDirectory() as folder:
        took = {}
        for name, number in (("first", 1), ("fixed", 1), ("all", count)):
            forget_peak()
            plan_s, wall_s = cpu_s(), time.perf_counter()
            run.run(ideal(number), Path(folder) / name, workers=1, scheduler=scheduler)
            took[name] = (cpu_s() - plan_s, time.perf_counter() - wall_s)
        size = (Path(folder) / "all" / "episodes.parquet").stat().st_size
    cpu, wall = (whole - fixed for whole, fixed in zip(took["all"], took["fixed"], strict=True))
    return {
        "scheduler": scheduler,
        "episodes": count,
        "cpu_s": cpu,
        "wall_s": wall,
        "peak_bytes": peak_bytes(),
        "row_bytes": size / count,
        "load": os.getloadavg()[0],
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
    half = (plan.episodes + plan.trials + plan.troubled) / 2
    found: dict[str, dict[str, str]] = {}
    victims: list[multiprocessing.process.BaseProcess] = []

    def kill_at_half(progress):
        told.append(progress.episodes)
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
            run.run(plan, Path(folder) / "run", workers=2, scheduler=scheduler, told=hook)
            paths = sorted((Path(folder) / "run").glob("*.parquet"))
            found[name] = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in paths}
    return {
        "units": len(plan.work),
        "killed": len(victims),
        "same": all(tables == found["threads"] for tables in found.values()),
        "tables": found,
    }


def apart(*words) -> dict:
    """What another process of this module measures."""
    answer = subprocess.run(
        [sys.executable, "-m", "bench.scale", *map(str, words)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if answer.returncode:
        raise SystemExit(answer.stderr)
    return json.loads(answer.stdout.splitlines()[-1])


def study(parts: tuple[str, ...], out: Path) -> None:
    """Measure the parts anew, and keep what the file says of the others."""
    content = read_json(out) if out.is_file() else {}
    for part in parts:
        if part == "sizes":
            content[part] = [apart("--run", THREADS, count) for count in SIZES]
        elif part == "schedulers":
            content[part] = [apart("--run", one, SHARED) for one in SCHEDULERS]
        else:
            content[part] = apart("--killed")
        about = describe()
        content.setdefault("provenance", {})[part] = {**about, "command": "python -m bench.scale"}
        write_json(out, content)
        print(f"{part}: {out}", flush=True)


def main() -> None:
    """Take the words of the command line."""
    parser = argparse.ArgumentParser(prog="python -m bench.scale", description=__doc__.split("\n")[0])
    parser.add_argument("--only", choices=PARTS, action="append", help="this part alone; repeatable")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "scale" / "scale.json")
    parser.add_argument("--run", nargs=2, metavar=("SCHEDULER", "COUNT"), help=argparse.SUPPRESS)
    parser.add_argument("--killed", action="store_true", help=argparse.SUPPRESS)
    words = parser.parse_args()
    if words.run:
        print(json.dumps(measured(words.run[0], int(words.run[1]))))
    elif words.killed:
        print(json.dumps(killed()))
    else:
        study(tuple(words.only or PARTS), words.out)


if __name__ == "__main__":
    main()
