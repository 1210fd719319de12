"""Kill runs at random moments, start them again, and compare their files with an undisturbed run's: results/survival.

PYTHONPATH=tests python tests/studies/kill_study.py                             a hundred kills: a quarter of an hour
PYTHONPATH=tests python tests/studies/kill_study.py --kills 10 --out try.json
"""

import argparse
import tempfile
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

from support.killed_clusters import LOCAL, STUDIED, gone_on_alone, gone_on_with
from support.killed_runs import Undisturbed, at_random_moments, undisturbed

from bench.base import files
from bench.base.provenance import ROOT, describe

SHARES = {"threads": (at_random_moments, 0.6), LOCAL: (gone_on_with, 0.2), "worker": (gone_on_alone, 0.2)}
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
                "goes_on_by": one.get("by", "threads"),
                "went_on": one["code"] == 0,
                "same": one["same"],
                "left_s": one.get("left_s"),
            }


def main() -> None:
    """Run the study; the file is written after every kill."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kills", type=int, default=100, help="how many, in all (default: 100)")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "survival" / "survival.json")
    options = parser.parse_args()
    about, began = describe() | {"command": "python tests/studies/kill_study.py"}, time.monotonic()
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
