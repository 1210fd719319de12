"""Flip bits of an unfinished run, swap and edit its parts and its plan, and give the same command again.

Each time the run is refused with a sentence, or the unit is run again and the tables are those of an undisturbed run.
SILENT is what must not be: other tables, and nothing said. Bits are spread evenly over the bytes of all parts.
"""

import contextlib
import io
import json
import random
import shutil
from collections import Counter
from pathlib import Path

from bench.base.errors import BadResults
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan, digest_of
from bench.experiments.tables.packed import pack, unpack
from bench.running import run
from bench.running.run_folder import SEAL, part
from support.killed import OTHER, SHORT, Undisturbed, files_of, undisturbed

SEED = 20260119
AGAIN, REFUSED, HARMLESS, SILENT = "run again", "refused", "harmless", "silent"
Changes = dict[str, dict[Path, bytes]]
"""Name of a change -> file of the run -> what it holds then."""


def stop_before_the_end(plan: Plan, out: Path) -> dict[Path, bytes]:
    """Run all units of a plan but not the end of the run; return its parts."""
    left = list(plan.units)

    def stop(_: Unit) -> None:
        left.pop()
        if not left:
            raise KeyboardInterrupt

    with contextlib.suppress(KeyboardInterrupt):
        run.run(plan, out, workers=1, report=stop)
    paths = (part(out, unit) for unit in plan.units)
    return {path.relative_to(out): path.read_bytes() for path in paths}


def disturb(wanted: Undisturbed, stopped: Path, changes: Changes) -> dict[str, str]:
    """Make each change in a copy of a stopped run, give the same command again, and return what became of it."""
    found = {}
    for name, files in changes.items():
        out, said, became = stopped.with_name("changed"), io.StringIO(), REFUSED
        shutil.copytree(stopped, out)
        for path, content in files.items():
            (out / path).write_bytes(content)
        with contextlib.redirect_stderr(said), contextlib.suppress(BadResults):
            run.run(wanted.plan, out, workers=1)
            is_same = files_of(out) == wanted.files
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


def edits(parts: dict[Path, bytes], others: dict[Path, bytes], plan: dict) -> Changes:
    """Return swaps and edits of parts and of the plan; others: parts of the same units with other gains."""
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
    of_plan |= {"a unit less": {"units": plan["units"][1:]}, "other rules": {"rules": []}}
    made = {f"part {name}": {first: content} for name, content in of_part.items()}
    made |= {"parts exchanged": {first: two, second: one}, "parts of other gains": others, "no plan": {at: b"{"}}
    for name, change in of_plan.items():
        whole = {key: value for key, value in plan.items() if key != "digest"} | change
        made[f"plan of {name}"] = {at: json.dumps(plan | change).encode()}
        made[f"plan of {name}, and its digest"] = {at: json.dumps(whole | {"digest": digest_of(whole)}).encode()}
    return made


def main(folder: Path, count: int) -> dict:
    """Make all these changes, and return what became of them: how many of the bits, and each of the edits."""
    wanted, stopped = undisturbed(SHORT, folder / "undisturbed"), folder / "stopped"
    parts, others = stop_before_the_end(SHORT, stopped), stop_before_the_end(OTHER, folder / "other")
    changes = edits(parts, others, json.loads((stopped / "plan.json").read_text()))
    flipped = disturb(wanted, stopped, flips(parts, count))
    return {"bits": dict(Counter(flipped.values())), "edits": disturb(wanted, stopped, changes)}
