"""Disturb small runs, give the same command again, and say what they end with.

Kill them by SIGKILL: everything is imported and compiled once; each run is then a fork of this process, so that it
costs its episodes and its files only. Flip bits, swap and edit parts and the plan: each time the run is refused with a
sentence, or the unit is run again and the tables are those of an undisturbed run. Tests of the tool start this module,
which prints as one JSON object what became of killed runs.
"""

import contextlib
import dataclasses
import io
import json
import os
import random
import shutil
import signal
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from bench.base.errors import BadResults
from bench.base.files import write_atomically
from bench.experiments import boundaries, plan, traces
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.request import Request
from bench.experiments.tables.packed import pack, unpack
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from bench.running import run
from bench.running.run_folder import SEAL, part
from support.command_line import digest

EVENTS = {"open", "os.mkdir", "os.remove", "os.rename", "os.rmdir", "os.chmod"}
SEED = 20260119
AGAIN, REFUSED, HARMLESS, SILENT = "run again", "refused", "harmless", "silent"
"""What becomes of a changed run; silent, which must not be: other tables, and nothing said."""


def plan_of(kp: float) -> plan.Plan:
    """Return a small plan of one law on the free body with curves, boundaries and costs."""
    law = find_contender("rotation-matrix")
    request = Request(
        "quick",
        (law,),
        Gains(kp, 20.0),
        count=3,
        horizon_s=0.25,
        tasks=("free-body",),
        start_sets=("paper", "tumbling"),
        engines=("ideal-rk4",),
    )
    made = plan.make(request)
    units = [unit for unit in made.of("free-body", "costs") if unit.contender == law.name]
    return dataclasses.replace(made, units=(*units, traces.of_law(law, 2), boundaries.of_law(law, 2)))


SHORT, OTHER = (plan_of(kp) for kp in (100.0, 50.0))
"""Five units, so few files: killed at every one of its file operations. OTHER is what SHORT replaces."""

Files = dict[str, str]
"""Every file of a run with its bytes' digest; provenance.json, which holds the time, has none."""


def files_of(out: Path) -> Files:
    return {name: "" if name == "provenance.json" else mark for name, mark in digest(out).items()}


def undisturbed(out: Path) -> Files:
    """Run SHORT in this process, so that every fork has what is compiled."""
    run.run(SHORT, out, workers=2)
    return files_of(out)


def end_of(one: plan.Plan, out: Path, before: Callable[[], None] = lambda: None) -> int:
    """Run a plan in a process of its own, and return its exit code, -9 if it was killed."""
    if child := os.fork():
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    try:
        before()
        run.run(one, out, workers=1, replace=True)
        os._exit(0)
    finally:
        os._exit(1)


def killing_at(number: int, out: Path) -> Callable[[], None]:
    """Return a function that makes a child die just before its file operation of that number in `out`."""
    seen = 0

    def hook(event: str, arguments: tuple) -> None:
        nonlocal seen
        if event == "open":  # a folder is opened to be locked or synced, and nothing changes
            path, _, flags = arguments
            if not str(path).startswith(str(out)) or flags & os.O_DIRECTORY:
                return
        seen += event in EVENTS
        if seen > number:
            os.kill(os.getpid(), signal.SIGKILL)

    return lambda: sys.addaudithook(hook)


def at_every_file_operation(
    files: Files, template: Path, is_over: Callable[[Path], bool] = lambda out: False
) -> list[dict]:
    """Kill runs in copies of a folder, each one file operation later, until one ends or `is_over(out)`; resume each.

    Return what lay in each folder, its units that were done, and what it ends with.
    """
    found: list[dict] = []
    while True:
        out = template.with_name(f"{template.name}-{len(found)}")
        shutil.copytree(template, out)
        if end_of(SHORT, out, before=killing_at(len(found), out)) == 0 or is_over(out):
            return found
        names, parts = sorted(path.name for path in out.glob("*")), len(list((out / "parts").glob("*.rows")))
        code = end_of(SHORT, out)
        found.append({"names": names, "parts": parts, "code": code, "same": files_of(out) == files})


def while_clearing(files: Files, folder: Path) -> list[dict]:
    """Kill a run that replaces a finished one of another plan, with parts, until the new plan is there."""
    template = folder / "clearing"
    end_of(OTHER, template)
    for name in ("a.parquet", ".a.parquet.b.tmp"):
        write_atomically(template / "parts" / name, lambda path: Path(path).write_text("half"))

    def is_new(out: Path) -> bool:
        path = out / "plan.json"
        return path.is_file() and json.loads(path.read_text())["digest"] == SHORT.digest

    return at_every_file_operation(files, template, is_new)


def kill_runs(folder: Path) -> dict:
    """Kill runs in all these ways, and return what the tests read."""
    files = undisturbed(folder / "short")
    (folder / "running").mkdir()
    running = at_every_file_operation(files, folder / "running")
    answer = {"files": sorted(files), "units": len(SHORT.units), "while running": running}
    return answer | {"while clearing": while_clearing(files, folder)}


Changes = dict[str, dict[Path, bytes]]
"""Name of a change -> file of the run -> what it holds then."""


def stop_before_the_end(one: plan.Plan, out: Path) -> dict[Path, bytes]:
    """Run all units of a plan but not the end of the run; return its parts."""
    left = list(one.units)

    def stop(_: Unit) -> None:
        left.pop()
        if not left:
            raise KeyboardInterrupt

    with contextlib.suppress(KeyboardInterrupt):
        run.run(one, out, workers=1, report=stop)
    paths = (part(out, unit) for unit in one.units)
    return {path.relative_to(out): path.read_bytes() for path in paths}


def disturb(wanted: Files, stopped: Path, changes: Changes) -> dict[str, str]:
    """Make each change in a copy of a stopped run, give the same command again, and return what became of it."""
    found = {}
    for name, files in changes.items():
        out, said, became = stopped.with_name("changed"), io.StringIO(), REFUSED
        shutil.copytree(stopped, out)
        for path, content in files.items():
            (out / path).write_bytes(content)
        with contextlib.redirect_stderr(said), contextlib.suppress(BadResults):
            run.run(SHORT, out, workers=1)
            is_same = files_of(out) == wanted
            became = (AGAIN if said.getvalue() else HARMLESS) if is_same else SILENT
        found[name] = became
        shutil.rmtree(out)
    return found


def flips(parts: dict[Path, bytes], count: int) -> Changes:
    """Return so many changes, each of one bit of a part."""
    every = [(path, bit) for path, content in parts.items() for bit in range(8 * len(content))]
    chance, step, made = random.Random(SEED), len(every) // count, {}
    for i in range(count):
        path, bit = every[i * step + chance.randrange(step)]
        number = int.from_bytes(parts[path], "little") ^ (1 << bit)
        made[f"{path.name}, bit {bit}"] = {path: number.to_bytes(len(parts[path]), "little")}
    return made


def edits(parts: dict[Path, bytes], others: dict[Path, bytes], kept: dict) -> Changes:
    """Return swaps and edits of parts and of the kept plan; others: parts of the same units with other gains."""
    (first, one), (second, two), *_ = parts.items()
    table, theirs, at = experiment_of(SHORT.units[0]).table, others[first], Path("plan.json")
    rows = unpack(one[SEAL:], table)
    edited = pack(rows.take(list(range(rows.num_rows))[::-1]), table)
    of_part = {"of other gains": theirs, "of another unit": two, "without a seal": one[SEAL:], "empty": b""}
    of_part |= {"a byte shorter": one[:-1], "its seal alone": one[:SEAL], "a byte longer": one + b"\0"}
    of_part |= {"of zeros": bytes(len(one)), "its rows twice": one + one[SEAL:], "edited": one[:SEAL] + edited}
    of_part |= {"edited, sealed for other gains": theirs[:SEAL] + edited}
    of_plan: dict[str, dict] = {
        "other gains": {"gains": [50.0, 20.0]},
        "another seed": {"seed": 1},
        "another period": {"dt_s": 2e-3},
    }
    of_plan |= {"a unit less": {"units": kept["units"][1:]}, "other rules": {"rules": []}}
    made = {f"part {name}": {first: content} for name, content in of_part.items()}
    made |= {"parts exchanged": {first: two, second: one}, "parts of other gains": others, "no plan": {at: b"{"}}
    for name, change in of_plan.items():
        whole = {key: value for key, value in kept.items() if key != "digest"} | change
        made[f"plan of {name}"] = {at: json.dumps(kept | change).encode()}
        made[f"plan of {name}, and its digest"] = {at: json.dumps(whole | {"digest": plan.digest_of(whole)}).encode()}
    return made


def change_files(folder: Path, count: int) -> dict:
    """Make all these changes, and return what became of them: how many of the bits, and each of the edits."""
    wanted, stopped = undisturbed(folder / "undisturbed"), folder / "stopped"
    parts, others = stop_before_the_end(SHORT, stopped), stop_before_the_end(OTHER, folder / "other")
    changes = edits(parts, others, json.loads((stopped / "plan.json").read_text()))
    flipped = disturb(wanted, stopped, flips(parts, count))
    return {"bits": dict(Counter(flipped.values())), "edits": disturb(wanted, stopped, changes)}


if __name__ == "__main__":
    print(json.dumps(kill_runs(Path(sys.argv[1]))))
