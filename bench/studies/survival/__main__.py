"""Kill runs at random moments, start them again, and compare their files with an undisturbed run's: results/survival.

python -m bench.studies.survival                             a hundred kills: a quarter of an hour
python -m bench.studies.survival --kills 10 --out try.json
"""

import contextlib
import functools
import multiprocessing
import os
import random
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

from bench.base import files
from bench.base.provenance import ROOT, describe
from bench.experiments.plan import Plan
from bench.running import run
from bench.studies.study import make_parser
from bench.studies.survival.killed import (
    ON_THREE,
    SEED,
    Undisturbed,
    at_random_moments,
    files_of,
    how_far,
    plan_of,
    undisturbed,
)

LOCAL = "local:2"
LONGEST_S = 30.0
"""After which what a killed run left behind is taken to stay."""
STUDIED = plan_of(("rotation-matrix",), *ON_THREE)
"""Free body, an arm and contact, on three engines."""


def on_processes(_: Plan, out: Path, __: random.Random) -> int:
    """Begin a run of STUDIED with a session of its own: a fork would lack Dask's threads. Return its id."""
    words = f"from bench.studies.survival.__main__ import *; run.run(STUDIED, Path({str(out)!r}), scheduler=LOCAL)"
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    return os.posix_spawn(sys.executable, [sys.executable, "-W", "ignore", "-c", words], environment, setsid=True)


def measure(session: int) -> dict:
    """Return how long the processes of a killed run stay; LONGEST_S if they do, and are killed now."""
    began = time.monotonic()
    while (waited := time.monotonic() - began) < LONGEST_S:
        if session not in sessions():
            return {"left_s": waited}
        time.sleep(0.01)
    os.killpg(session, signal.SIGKILL)
    return {"left_s": LONGEST_S}


def sessions() -> Iterator[int]:
    """Yield the session of every process of this machine that has not ended."""
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it ended in this moment
            state, _, _, session = path.read_text().rpartition(") ")[2].split()[:4]
            if state != "Z":
                yield int(session)


def at_random_units(wanted: Undisturbed, folder: Path, kills: int) -> Iterator[dict]:
    """One of two workers killed when a random unit but the last is done; the run goes on with the other."""
    chance = random.Random(SEED)
    for k in range(kills):
        out, todo = folder / f"worker-{k}", list(wanted.plan.units)
        at: list[dict] = []
        last = chance.randrange(1, len(todo))

        def kill_a_worker(_: Any, out: Path = out, todo: list = todo, at: list = at, last: int = last) -> None:
            todo.pop()
            if len(todo) == last:
                at.append(how_far(out))
                chance.choice(multiprocessing.active_children()).kill()

        run.run(wanted.plan, out, scheduler=LOCAL, report=kill_a_worker)
        yield {**at[0], "by": "itself", "code": 0, "same": files_of(out) == wanted.files}


SHARES: dict[str, tuple[Callable[..., Iterator[dict]], float]] = {
    "threads": (at_random_moments, 0.6),
    LOCAL: (functools.partial(at_random_moments, begin=on_processes, measure=measure), 0.2),
    "worker": (at_random_units, 0.2),
}
"""What is killed -> how, and its share of the kills. Runs with Dask come last: a fork would lack its threads."""


def kill_runs(wanted: Undisturbed, folder: Path, kills: int) -> Iterator[dict]:
    """Kill runs, and yield how far each had come and what it ended with."""
    for what, (kill, share) in SHARES.items():
        for one in kill(wanted, folder, round(share * kills)):
            tables = sum(name.endswith(".parquet") for name in one["names"])
            yield {
                "killed": what,
                "units_done": one["parts"],
                "tables_done": tables,
                "goes_on_by": {"on_threads": "threads", "on_processes": LOCAL}.get(one["by"], one["by"]),
                "went_on": one["code"] == 0,
                "same": one["same"],
                "left_s": one.get("left_s"),
            }


def main() -> None:
    """Run the study; the file is written after every kill."""
    parser = make_parser("survival", __doc__, out=ROOT / "results" / "survival" / "survival.json")
    parser.add_argument("--kills", type=int, default=100, help="how many, in all (default: 100)")
    options = parser.parse_args()
    about, began = describe() | {"command": "python -m bench.studies.survival"}, time.monotonic()
    about["versions"]["distributed"] = version("distributed")
    found: dict = {"provenance": about, "units": len(STUDIED.units), "kills": []}
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as here:
        wanted = undisturbed(STUDIED, Path(here) / "undisturbed")
        found["tables"] = sum(name.endswith(".parquet") for name in wanted.files)
        for row in kill_runs(wanted, Path(here), options.kills):
            found["kills"].append(row)
            about["wall_s"] = round(time.monotonic() - began)
            files.write_json(options.out, found)
            print(f"{len(found['kills'])}: {row}", flush=True)


if __name__ == "__main__":
    main()
