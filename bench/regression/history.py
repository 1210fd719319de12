"""The history: one file of pytest-benchmark for each measured build.

Limitations: times compare only on one machine.
"""

from pathlib import Path

import pandas as pd

from bench.base.errors import BadResults
from bench.base.files import read_json
from bench.base.provenance import ROOT, commit
from bench.experiments.tables.schema import RESULTS
from bench.regression.timer import ROUNDS, Side, run_benchmarks

FOLDER = RESULTS / "history"


def append_build(folder: Path = FOLDER, rounds: int = ROUNDS) -> Path:
    """Measure the commit of this checkout and add its file; return the file."""
    about = commit()
    if about["dirty"] or not about["commit"]:
        raise BadResults("this checkout has changes that no commit holds, and the history holds commits; commit them")
    before = set(find_files(folder))
    options = (f"--benchmark-storage={Path(folder).resolve()}", "--benchmark-autosave")
    run_benchmarks([Side(ROOT)], options, rounds)
    [new] = set(find_files(folder)) - before
    return new


def find_files(folder: Path = FOLDER) -> list[Path]:
    """Return the files of a history."""
    return sorted(Path(folder).glob("*/[0-9]*.json"))


def read_history(folder: Path = FOLDER) -> pd.DataFrame:
    """Return a row for each benchmark of each build, in the order of the commits.

    kernel_steps, low, high: time of a tick over a step of the reference kernel. flops: of the
    typical branch, or NaN.
    """
    rows = []
    for path in find_files(folder):
        content = read_json(path)
        try:
            about, machine = content["commit_info"], content["machine_info"]["key"]
            date = pd.to_datetime(about["time"], utc=True)
            for benchmark in content["benchmarks"]:
                info = benchmark["extra_info"]
                median, low, high = info["kernel_steps"]
                row = {
                    "commit": about["id"],
                    "date": date,
                    "machine": machine,
                    "what": info["what"],
                    "name": benchmark["param"],
                    "kernel_steps": median,
                    "low": low,
                    "high": high,
                    "flops": float(info["flops"].get("typical", "nan")),
                }
                rows.append(row)
        except (KeyError, TypeError, ValueError) as error:
            raise BadResults(f"{path}: no build of this history ({error!r}); delete it, or take it from git") from error
    frame = pd.DataFrame(rows)
    return frame.sort_values("date", kind="stable", ignore_index=True) if rows else frame
