"""Flip bits of an unfinished run, swap and edit its parts and its plan, and give the same command again.

    python -m bench.studies.survival.flipped                 400 bits, and every swap and edit
    python -m bench.studies.survival.flipped --flips 20

Each time the run is refused with a sentence, or the unit is run again and the tables are those of an undisturbed run;
"silent" is what must not be: other tables, and nothing said. Bits are spread evenly over the bytes of all parts.
"""

import argparse
import contextlib
import io
import json
import random
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from bench.base.errors import BadResults
from bench.experiments.experiment import Unit, experiment_of
from bench.experiments.plan import Plan, digest_of
from bench.experiments.tables.packed import pack, unpack
from bench.running import run
from bench.running.run_folder import SEAL, part, write_part
from bench.studies.survival.killed import OTHER, SEED, SHORT, Undisturbed, files_of, undisturbed

FLIPS = 400
AGAIN, REFUSED, HARMLESS, SILENT = "run again", "refused", "harmless", "silent"


def stop_before_the_end(plan: Plan, out: Path) -> None:
    """Run all units of a plan but not the end of the run."""
    left = list(plan.units)

    def stop(_: Unit) -> None:
        left.pop()
        if not left:
            raise KeyboardInterrupt

    with contextlib.suppress(KeyboardInterrupt):
        run.run(plan, out, workers=1, report=stop)


def go_on(wanted: Undisturbed, out: Path) -> str:
    """Give the same command again, and return what became of it."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            run.run(wanted.plan, out, workers=1)
    except BadResults:
        return REFUSED
    is_same = files_of(out) == wanted.files
    if said.getvalue():
        return AGAIN if is_same else SILENT
    return HARMLESS if is_same else SILENT


def disturb(
    wanted: Undisturbed, stopped: Path, changes: dict[str, Callable[[Path], None]]
) -> Iterator[tuple[str, str]]:
    """Yield what became of a copy of a stopped run after each change."""
    for name, change in changes.items():
        out = stopped.with_name("changed")
        shutil.copytree(stopped, out)
        change(out)
        yield name, go_on(wanted, out)
        shutil.rmtree(out)


def flips(plan: Plan, stopped: Path, count: int) -> dict[str, Callable[[Path], None]]:
    """Return so many changes, each of one bit of a part."""
    paths = [part(stopped, unit).relative_to(stopped) for unit in plan.units]
    ends = [(stopped / path).stat().st_size for path in paths]
    chance = random.Random(SEED)

    def flip(place: int, bit: int) -> Callable[[Path], None]:
        def change(out: Path) -> None:
            content, at = bytearray((out / paths[place]).read_bytes()), bit // 8
            content[at] ^= 1 << bit % 8
            (out / paths[place]).write_bytes(content)

        return change

    every = [(place, bit) for place, size in enumerate(ends) for bit in range(8 * size)]
    chosen = [chance.choice(every[i * len(every) // count : (i + 1) * len(every) // count]) for i in range(count)]
    return {f"part {place}, bit {bit}": flip(place, bit) for place, bit in chosen}


def edit_plan(keep_digest: bool, **more: Any) -> Callable[[Path], None]:
    """Return a change of plan.json: other values, and the old digest or the new one's."""

    def change(out: Path) -> None:
        content = json.loads((out / "plan.json").read_text())
        digest = content.pop("digest")
        content |= more
        (out / "plan.json").write_text(json.dumps(content | {"digest": digest if keep_digest else digest_of(content)}))

    return change


def edits(plan: Plan, stopped: Path, other: Path) -> dict[str, Callable[[Path], None]]:
    """Return swaps and edits of parts and of the plan; other: a stopped run of the same units with other gains."""
    first, second = (part(stopped, unit).relative_to(stopped) for unit in plan.units[:2])

    def on_part(change: Callable[[bytes], bytes]) -> Callable[[Path], None]:
        def changed(out: Path) -> None:
            (out / first).write_bytes(change((out / first).read_bytes()))

        return changed

    def edited(content: bytes) -> bytes:
        """Return the part with its rows in the reverse order, under its old seal."""
        table = experiment_of(plan.units[0]).table
        rows = unpack(content[SEAL:], table)
        return content[:SEAL] + pack(rows.take(list(range(rows.num_rows))[::-1]), table)

    def resealed(out: Path) -> None:
        """Seal edited rows for the plan with other gains."""
        write_part(OTHER, out, plan.units[0], edited((out / first).read_bytes())[SEAL:])

    def exchange(out: Path) -> None:
        one, two = (out / first).read_bytes(), (out / second).read_bytes()
        (out / first).write_bytes(two)
        (out / second).write_bytes(one)

    units = json.loads((stopped / "plan.json").read_text())["units"]
    return {
        "part of a run with other gains": lambda out: shutil.copy(other / first, out / first),
        "all parts of a run with other gains": lambda out: shutil.copytree(
            other / "parts", out / "parts", dirs_exist_ok=True
        ),
        "part of another unit": lambda out: shutil.copy(out / second, out / first),
        "two parts exchanged": exchange,
        "part truncated by a byte": on_part(lambda content: content[:-1]),
        "part truncated to its seal": on_part(lambda content: content[:SEAL]),
        "empty part": on_part(lambda content: b""),
        "part with a byte more": on_part(lambda content: content + b"\0"),
        "part with its rows twice": on_part(lambda content: content + content[SEAL:]),
        "part of zeros": on_part(lambda content: bytes(len(content))),
        "part with edited rows": on_part(edited),
        "part with edited rows, sealed for another plan": resealed,
        "part without a seal": on_part(lambda content: content[SEAL:]),
        "plan with other gains": edit_plan(True, gains=[50.0, 20.0]),
        "plan with other gains and its digest": edit_plan(False, gains=[50.0, 20.0]),
        "plan with another seed": edit_plan(True, seed=1),
        "plan with another control period": edit_plan(True, dt_s=2e-3),
        "plan without a unit": edit_plan(True, units=units[1:]),
        "plan without a unit, and its digest": edit_plan(False, units=units[1:]),
        "plan of other rules": edit_plan(True, rules=[]),
        "plan of other sources": edit_plan(False, sources="0" * 16),
        "plan of another run": lambda out: shutil.copy(other / "plan.json", out / "plan.json"),
        "plan that is no JSON": lambda out: (out / "plan.json").write_text("{"),
        "no plan": lambda out: (out / "plan.json").unlink(),
    }


def main(folder: Path, count: int = FLIPS) -> dict:
    """Make all these changes, and return what became of each."""
    wanted, stopped, other = undisturbed(SHORT, folder / "undisturbed"), folder / "stopped", folder / "other"
    stop_before_the_end(SHORT, stopped)
    stop_before_the_end(OTHER, other)
    flipped = Counter(became for _, became in disturb(wanted, stopped, flips(SHORT, stopped, count)))
    return {"bits": dict(flipped), "edits": dict(disturb(wanted, stopped, edits(SHORT, stopped, other)))}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flips", type=int, default=FLIPS, help=f"how many bits (default: {FLIPS})")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as here:
        json.dump(main(Path(here), options.flips), sys.stdout, indent=1)
