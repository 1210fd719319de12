"""Kill runs by SIGKILL, resume them, and print as one JSON object what they end with; a test of the tool starts this.

Everything is imported and compiled once; each run is then a fork of this process, so that a run costs its episodes and
its files only.
"""

import dataclasses
import json
import os
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from bench.base.files import write_atomically
from bench.experiments import boundaries, plan, traces
from bench.experiments.choice import Choice
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from bench.running import run
from support.command_line import digest

EVENTS = {"open", "os.mkdir", "os.remove", "os.rename", "os.rmdir", "os.chmod"}


def plan_of(kp: float) -> plan.Plan:
    """Return a small plan of one law on the free body with curves, boundaries and costs."""
    law, choice = find_contender("rotation-matrix"), Choice(("free-body",), ("paper", "tumbling"), ("ideal-rk4",))
    made = plan.make("quick", [law], choice, count=3, horizon_s=0.25, gains=Gains(kp, 20.0))
    units = [unit for unit in made.of("free-body", "costs") if unit.contender == law.name]
    return dataclasses.replace(made, units=(*units, traces.of_law(law, 2), boundaries.of_law(law, 2)))


SHORT, OTHER = (plan_of(kp) for kp in (100.0, 50.0))
"""Five units, so few files: killed at every one of its file operations. OTHER is what SHORT replaces."""


class Undisturbed(NamedTuple):
    """A plan, and the files that a run of it ends with."""

    plan: plan.Plan
    files: dict


def start(one: plan.Plan, out: Path, before: Callable[[], None] = lambda: None) -> int:
    """Start a run in a process of its own, and return its id."""
    child = os.fork()
    if child:
        return child
    try:
        before()
        run.run(one, out, workers=1, replace=True)
        os._exit(0)
    finally:
        os._exit(1)


def ended(child: int) -> int:
    """Wait for a process and return its exit code, -9 if it was killed."""
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def files_of(out: Path) -> dict[str, str]:
    """Return every file of a run with its bytes' digest; provenance.json, which holds the time, has none."""
    return {name: "" if name == "provenance.json" else mark for name, mark in digest(out).items()}


def undisturbed(one: plan.Plan, out: Path) -> Undisturbed:
    """Run a plan in this process, so that every fork has what is compiled."""
    run.run(one, out, workers=2)
    return Undisturbed(one, files_of(out))


def resumed(wanted: Undisturbed, out: Path) -> dict:
    """Resume a killed run, and return what lay in its folder, its units that were done, and what it ends with."""
    names, parts = sorted(path.name for path in out.glob("*")), len(list((out / "parts").glob("*.rows")))
    code = ended(start(wanted.plan, out))
    return {"names": names, "parts": parts, "code": code, "same": files_of(out) == wanted.files}


def is_file_below(out: Path, path: Any, _: Any, flags: int) -> bool:
    """Return whether a file of the run was opened; a folder is opened to be locked or synced, and nothing changes."""
    return str(path).startswith(str(out)) and not flags & os.O_DIRECTORY


def killing_at(number: int, out: Path) -> Callable[[], None]:
    """Return a function that makes a child die just before its file operation of that number in `out`."""
    seen = 0

    def hook(event: str, arguments: tuple) -> None:
        nonlocal seen
        if event in EVENTS and (event != "open" or is_file_below(out, *arguments)):
            seen += 1
            if seen > number:
                os.kill(os.getpid(), signal.SIGKILL)

    return lambda: sys.addaudithook(hook)


def at_every_file_operation(
    wanted: Undisturbed, template: Path, is_over: Callable[[Path], bool] = lambda out: False
) -> list[dict]:
    """Kill runs in copies of a folder, each one file operation later, until one ends or `is_over(out)`; resume each."""
    found: list[dict] = []
    while True:
        out = template.with_name(f"{template.name}-{len(found)}")
        shutil.copytree(template, out)
        if ended(start(wanted.plan, out, before=killing_at(len(found), out))) == 0 or is_over(out):
            return found
        found.append(resumed(wanted, out))


def while_clearing(wanted: Undisturbed, folder: Path) -> list[dict]:
    """Kill a run that replaces a finished one of another plan, with parts, until the new plan is there."""
    template = folder / "clearing"
    ended(start(OTHER, template))
    for name in ("a.parquet", ".a.parquet.b.tmp"):
        write_atomically(template / "parts" / name, lambda path: Path(path).write_text("half"))

    def is_new(out: Path) -> bool:
        path = out / "plan.json"
        return path.is_file() and json.loads(path.read_text())["digest"] == wanted.plan.digest

    return at_every_file_operation(wanted, template, is_new)


def main(folder: Path) -> dict:
    """Kill runs in all these ways, and return what the tests read."""
    short = undisturbed(SHORT, folder / "short")
    answer: dict[str, Any] = {"files": sorted(short.files), "units": len(SHORT.units)}
    (folder / "running").mkdir()
    answer["while running"] = at_every_file_operation(short, folder / "running")
    answer["while clearing"] = while_clearing(short, folder)
    return answer


if __name__ == "__main__":
    print(json.dumps(main(Path(sys.argv[1]))))
