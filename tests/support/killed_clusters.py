"""Runs on two processes of this machine: all of it killed, and gone on with; one process killed, and nothing else done.

`python -m support.killed_clusters OUT` is such a run, a process of its own and no fork: it would lack Dask's threads.
"""

import contextlib
import multiprocessing
import os
import random
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

from bench.base.provenance import ROOT
from bench.running import run
from support.killed_runs import SEED, TRIES, Undisturbed, ended, files_of, how_far, plan_of, start

STUDIED = plan_of(("rotation-matrix",), ("half-turn", "paper"), ("ideal-rk4", "native", "reference"), 12)
"""Free body, an arm and contact, on three engines."""

LOCAL = "local:2"
LONGEST_S = 30.0
"""After which what a killed run left behind is taken to stay."""


def begun(out: Path) -> subprocess.Popen:
    """Such a run, with a session of its own, to which all its processes belong."""
    words = [sys.executable, "-W", "ignore", "-m", "support.killed_clusters", str(out)]
    path = os.pathsep.join(map(str, (ROOT, ROOT / "tests")))
    return subprocess.Popen(words, env={**os.environ, "PYTHONPATH": path}, start_new_session=True)


def left_s(session: int) -> float:
    """Seconds until the processes of a killed run are gone; LONGEST_S if they stay, and are killed now."""
    began = time.monotonic()
    while (waited := time.monotonic() - began) < LONGEST_S:
        if not any(one == session for one in sessions()):
            return waited
        time.sleep(0.01)
    os.killpg(session, signal.SIGKILL)
    return LONGEST_S


def sessions() -> Iterator[int]:
    """Yield the session of every process of this machine that has not ended."""
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it ended in this moment
            state, _, _, session = path.read_text().rpartition(") ")[2].split()[:4]
            if state != "Z":
                yield int(session)


def gone_on_with(wanted: Undisturbed, folder: Path, kills: int) -> Iterator[dict]:
    """The run's process killed at a random moment from its first file on; then resumed, on threads or processes."""
    chance, found = random.Random(SEED), 0
    first = begun(folder / "local")
    until_it_writes(folder / "local", first)
    began = time.monotonic()
    first.wait()
    longest = time.monotonic() - began
    for k in range(TRIES * kills):
        if found == kills:
            return
        out = folder / f"local-{k}"
        process = begun(out)
        until_it_writes(out, process)
        time.sleep(chance.uniform(0.0, longest))
        process.kill()
        if process.wait() == -signal.SIGKILL:
            found += 1
            far = {"left_s": left_s(process.pid), **how_far(out), "by": chance.choice(("threads", LOCAL))}
            code = begun(out).wait() if far["by"] == LOCAL else ended(start(wanted.plan, out, 2))
            yield {**far, "code": code, "same": files_of(out) == wanted.files}


def until_it_writes(out: Path, process: subprocess.Popen) -> None:
    """Wait for the first file of a run."""
    while not (out / "plan.json").is_file() and process.poll() is None:
        time.sleep(0.01)


def gone_on_alone(wanted: Undisturbed, folder: Path, kills: int) -> Iterator[dict]:
    """One of two workers killed at a random moment at which units are left; the run goes on with the other.

    How long a run takes from its first file on is known from the one before; the first is left alone.
    """
    chance, found, longest = random.Random(SEED), 0, 0.0
    for k in range(TRIES * kills):
        if found == kills:
            return
        out, todo, at = folder / f"worker-{k}", list(wanted.plan.units), []
        moment = chance.uniform(0.0, longest)
        killer = threading.Thread(target=kill_worker, args=(out, moment, chance, todo, at))
        if longest:
            killer.start()
        run.run(wanted.plan, out, scheduler=LOCAL, report=lambda _, todo=todo: todo.pop())
        longest = time.time() - (out / "plan.json").stat().st_mtime
        if killer.is_alive():
            killer.join()
        if at:
            found += 1
            yield {**at[0], "by": "itself", "code": 0, "same": files_of(out) == wanted.files}


def kill_worker(out: Path, moment: float, chance: random.Random, todo: list, at: list[dict]) -> None:
    """Kill a worker so long after the run's first file, if there is anything to do yet; note how far it has come."""
    while not (out / "plan.json").is_file():
        time.sleep(0.01)
    time.sleep(moment)
    if todo:
        at.append(how_far(out))
        chance.choice(multiprocessing.active_children()).kill()


def main(out: Path) -> None:
    """A run of STUDIED on processes."""
    run.run(STUDIED, out, scheduler=LOCAL)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
