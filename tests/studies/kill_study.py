"""The kill study (`make kill-study`): runs killed at random, disks that fill up, laws that break; results/survival.

What a run ends with is compared, file by file, with what it ends with undisturbed.
"""

import argparse
import os
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

from support import breaking_laws
from support.killed_clusters import LOCAL, STUDIED, gone_on_alone, gone_on_with
from support.killed_runs import Undisturbed, at_random_moments, files_of, undisturbed
from support.small_disk import NoDisk, fill, mounted

from bench import files
from bench.errors import BadResults
from bench.provenance import ROOT, describe
from bench.running import run
from bench.tables import store

KILLS = 100
SHARES = {"threads": 0.6, LOCAL: 0.2, "worker": 0.2}
"""What is killed -> its share of the kills."""

LEFT_KB = (0, 12, 24, 48, 96, 144, 192, 256, 320, 400)
"""Room on the disk when a run begins: from nothing to nearly enough."""

LAWS = {
    "raises an error": ("ideal-rk4", "if R.n[0] < -0.1: raise ValueError('no')"),
    "returns two numbers": ("reference", "if R.n[0] < -0.1: return (1.0, 2.0)"),
    "returns words": ("reference", "if R.n[0] < -0.1: return ('a', 'b', 'c')"),
    "returns NaN": ("ideal-rk4", "if R.n[0] < -0.1: x = x * float('nan')"),
    "ends its process": ("reference", "if R.n[0] < -0.1: os._exit(3)"),
    "never returns, compiled": ("ideal-rk4", "while R.n[0] < -0.1: x = x + 1e-9"),
    "never returns, in Python": ("reference", "while R.n[0] < -0.1: x = x + 1e-9"),
}
"""What a law does in some states -> the engine it is run on, and its line."""


def killed(wanted: Undisturbed, folder: Path, kills: int) -> Iterator[dict]:
    """Runs killed, and what they ended with. Those with Dask come last: a fork would lack its threads."""
    ways = {"threads": at_random_moments, LOCAL: gone_on_with, "worker": gone_on_alone}
    for what, way in ways.items():
        for one in way(wanted, folder, round(SHARES[what] * kills)):
            tables = sum(name.endswith(".parquet") for name in one["names"])
            yield {
                "killed": what,
                "units_done": one["parts"],
                "tables_done": tables,
                "goes_on_by": one.get("by", "threads"),
                "went_on": one["code"] == 0,
                "same": one["same"],
                "left_s": one.get("left_s"),
            }


def on_full_disks(wanted: Undisturbed, folder: Path) -> Iterator[dict]:
    """Runs on a disk with little room, and again when there is some."""
    for left in LEFT_KB:
        with mounted(folder / f"disk-{left}") as disk:
            filler, out, said = fill(disk, left), disk / "run", ""
            try:
                run.run(wanted.plan, out, workers=2)
            except BadResults as error:
                said = Path(str(error).partition(": cannot be written (No space left")[0]).name
            kept = len(list((out / "parts").glob("*.parquet")))
            leftovers = sum(map(files.is_leftover, out.rglob("*")))
            filler.unlink()
            run.run(wanted.plan, out, workers=2)
            counts = {"left_kb": left, "failed_at": said, "units_kept": kept, "leftovers": leftovers}
            yield {**counts, "same": files_of(out) == wanted.files}


def with_broken_laws(folder: Path) -> Iterator[dict]:
    """A law that breaks in some states beside one of ours, and what became of both."""
    engines = {engine for engine, _ in LAWS.values()}
    sound = {engine: rows_of(folder / f"sound-{engine}", engine, "pass") for engine in engines}
    for k, (what, (engine, line)) in enumerate(LAWS.items()):
        rows = rows_of(folder / f"law-{k}", engine, line)
        own = rows.index.get_level_values("regulator") == "mine"
        broken = own & (rows["outcome"] != sound[engine]["outcome"])
        same = rows[~broken].equals(sound[engine][~broken])
        outcomes = dict(Counter(rows.loc[own, "outcome"]))
        yield {"law": what, "engine": engine, "outcomes": outcomes, "broken": int(broken.sum()), "others_same": same}


def rows_of(folder: Path, engine: str, line: str):
    """The episodes of our law and of a user's with that line, by law and start."""
    folder.mkdir()
    plan = breaking_laws.plan_of(folder, line, engine=engine)
    run.run(plan, folder / "run", workers=2, law_limit_s=1.0)
    made = store.read(folder / "run", "episodes").astype({"outcome": str})
    return made.set_index(["regulator", "start_id"])


def study(folder: Path, kills: int, out: Path) -> None:
    """All of it, in a folder that may go; the file is written after every row, and each is told."""
    about, began = describe() | {"command": "make kill-study"}, time.monotonic()
    about["versions"]["distributed"] = version("distributed")
    found: dict = {"provenance": about, "units": len(STUDIED.units), "laws": [], "kills": [], "disks": []}

    def keep(part: str, rows: Iterator[dict]) -> None:
        for row in rows:
            found[part].append(row)
            about["wall_s"] = round(time.monotonic() - began)
            files.write_json(out, found)
            print(f"{part} {len(found[part])}: {row}", flush=True)

    wanted = undisturbed(STUDIED, folder / "undisturbed")
    found["tables"] = sum(name.endswith(".parquet") for name in wanted.files)
    keep("kills", killed(wanted, folder, kills))
    try:
        keep("disks", on_full_disks(wanted, folder))
    except NoDisk as error:
        print(f"no full disk: {error}", file=sys.stderr)
    keep("laws", with_broken_laws(folder))


def main() -> None:
    """Take the words of the command line."""
    parser = argparse.ArgumentParser(prog="make kill-study", description=__doc__.split("\n")[0])
    parser.add_argument("--kills", type=int, default=KILLS, help=f"how many, in all (default: {KILLS})")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "survival" / "survival.json")
    words = parser.parse_args()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as here:
        os.environ["XDG_STATE_HOME"] = here  # the laws of the study are none of this user's
        study(Path(here), words.kills, words.out)


if __name__ == "__main__":
    main()
