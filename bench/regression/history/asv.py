"""The history as results of asv, laid out as its documentation says ("Benchmark suite layout and file formats").

A benchmark is a measure, its parameter the law or engine; a file is what one machine measured of one commit, or NaN.
"""

import math
from datetime import datetime
from pathlib import Path

from bench.regression.history.record import Record
from bench.regression.history.series import MEASURES, points
from bench.tables.files import write_json


def write(lines: list[Record], folder: Path) -> None:
    """The folder that a project's asv.conf.json names as `results_dir`."""
    names = sorted({one.benchmark.name for one in lines})
    params = [[repr(name) for name in names]]
    about = {"type": "track", "code": "", "version": "1", "unit": "a tick", "param_names": ["law"], "params": params}
    write_json(folder / "benchmarks.json", {"version": 2} | {one: {**about, "name": one} for one in MEASURES})
    for commit, date, machine in {(one.commit, one.date, one.machine) for one in lines}:
        build = [one for one in lines if (one.commit, one.machine) == (commit, machine)]
        found = {(measure, one.benchmark.name): at.value for one in build for measure, at in points(one).items()}
        results = {one: [[found.get((one, name), math.nan) for name in names], params, "1"] for one in MEASURES}
        made = {"commit_hash": commit, "date": 1000 * int(datetime.fromisoformat(date).timestamp()), "version": 2}
        kept = {"result_columns": ["result", "params", "version"], "results": results, "durations": {}, "env_vars": {}}
        place = {"params": {"machine": machine}, "env_name": "locked", "python": "", "requirements": {}}
        write_json(folder / machine / f"{commit[:8]}-locked.json", made | kept | place)
        write_json(folder / machine / "machine.json", {"machine": machine, "version": 1})
