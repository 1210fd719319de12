"""The study of many episodes as its page reads it: results/scale, which is committed."""

from __future__ import annotations

from typing import Any

import pandas as pd

from bench.running.schedulers.words import THREADS
from bench.tables.schema import RESULTS
from bench.tables.store import read_json

FILE = RESULTS / "scale" / "scale.json"
NOT_RUN = "This part of the study has not been run yet: make scale-study"
FEW, MANY = 10**4, 10**6
"""Episodes of the two runs that are held against each other."""

MEASURED = ["scheduler", "episodes", "cpu_s", "own_cpu_s", "wall_s", "others", "peak_bytes", "row_bytes", "rows"]


def study() -> dict[str, Any]:
    """All that was measured, part by part; empty if nothing was."""
    return read_json(FILE) if FILE.is_file() else {}


def sizes(found: dict[str, Any]) -> pd.DataFrame:
    """A row a number of episodes, from few to many: over its runs the median, and the least and most of their cost."""
    runs = pd.DataFrame(found.get("sizes", []), columns=MEASURED)
    runs["each_us"] = 1e6 * runs["cpu_s"] / runs["episodes"]
    of_size = runs.groupby("episodes").agg(
        runs=("each_us", "size"),
        each_us=("each_us", "median"),
        least_us=("each_us", "min"),
        most_us=("each_us", "max"),
        peak_bytes=("peak_bytes", "median"),
        row_bytes=("row_bytes", "median"),
    )
    return of_size.reset_index()


def schedulers(found: dict[str, Any]) -> pd.DataFrame:
    """A row a scheduler, one thread first.

    Columns: scheduler, episodes, processes; CPU an episode of all of them, each_us, and of the command's own alone,
    own_us; wall_s; efficiency, one thread's time over that of all processes, by_cpu and by_wall; others, the cores that
    other programs took.
    """
    rows = pd.DataFrame(found.get("schedulers", []), columns=MEASURED)
    alone = rows.iloc[:1].squeeze()
    rows["processes"] = [1 if one == THREADS else int(one.partition(":")[2]) for one in rows["scheduler"]]
    rows["each_us"], rows["own_us"] = (1e6 * rows[name] / rows["episodes"] for name in ("cpu_s", "own_cpu_s"))
    rows["by_cpu"] = alone["cpu_s"] / rows["cpu_s"]
    rows["by_wall"] = alone["wall_s"] / (rows["processes"] * rows["wall_s"])
    return rows


def tables_apart(found: dict[str, Any]) -> list[str]:
    """Names of tables whose bytes hang on the scheduler, or on a worker that was killed."""
    by_threads, *others = found["killed"]["tables"].values()
    names = dict.fromkeys(name for tables in (by_threads, *others) for name in tables)
    return [name for name in names if any(tables.get(name) != by_threads.get(name) for tables in others)]


def rows_are_same(found: dict[str, Any]) -> bool:
    """Whether runs of as many episodes have the same bytes, whoever carried them out."""
    runs = pd.DataFrame([*found.get("sizes", []), *found.get("schedulers", [])], columns=MEASURED)
    return bool((runs.groupby("episodes")["rows"].nunique() == 1).all())
