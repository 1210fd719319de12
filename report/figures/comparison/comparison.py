"""The page that compares all laws: on the same uniform starts, at the same gains and at the same peak command."""

import functools
import math
from collections.abc import Iterator

import numpy as np
import pandas as pd

from bench.experiments.tables import read
from bench.findings.selection.needs import measured
from report.figures.comparison import cells
from report.figures.kit import families, html
from report.figures.kit.page import Run, in_run
from report.figures.kit.tables import Table

ALL_LAWS = Table("Law | Settles [%] | Median [s] | 99 % [s] | Effort | Peak | A tick | Lost | Held")
NEAR_DEG = 30, 60
ANISOTROPIC = "weighted-columns"
"""Its stiffness is the others' on the average over its axes alone."""


@functools.cache
def ideal(run: Run) -> pd.DataFrame:
    """Episodes of the free body on the continuous plant."""
    return run.rows("episodes", engine="ideal-rk4", **read.FREE_BODY)


@functools.cache
def uniform(run: Run) -> pd.DataFrame:
    """Return the episodes from uniform starts that every law ran."""
    return cells.common(ideal(run))


def facts(run: Run) -> dict:
    """Return the numbers of the laws that are not negative controls, and the table of all laws."""
    rows, tried = uniform(run), cells.directed_starts(ideal(run))
    times, efforts = cells.costs(rows, "settling_time_s"), cells.costs(rows, "effort")
    laws = [name for name in times if name not in families.CONTROLS]
    middle, spent = (table[laws].quantile(interpolation="lower") for table in (times, efforts))
    lost = set(tried.loc[tried["outcome"] != "settled", "contender"])
    return {
        "laws": len(laws),
        "starts": len(times),
        "kp": float(rows["kp"].iloc[0]),
        "kv": float(rows["kv"].iloc[0]),
        "fastest_s": f"{middle.min():.2f}",
        "slowest_s": f"{middle.max():.2f}",
        "whole": int(sum(np.isfinite(times[name]).all() for name in laws)),
        "dearer": f"{spent.max() / spent.min():.0f}",
        **near(rows[rows["contender"].isin(laws)]),
        "left": len(set(tried["contender"]) - lost - set(families.CONTROLS)),
        "directed": int(tried.groupby("contender", observed=True).size().max()),
        "all_laws": ALL_LAWS(compare_laws(run, times, efforts)),
    }


def near(rows: pd.DataFrame) -> dict:
    """Return by how much the laws' medians from starts near the goal differ, weighted columns aside."""
    found: dict = {}
    for angle in NEAR_DEG:
        own = rows[(rows["angle0_rad"] < np.radians(angle)) & (rows["contender"] != ANISOTROPIC)]
        middles = own.groupby(own["contender"].astype(str))["settling_time_s"].median()
        apart = f"{math.ceil(100.0 * (middles.max() / middles.min() - 1.0) - 1e-9)}"  # "or less"
        found |= {f"within_{angle}": own["start_id"].nunique(), f"apart_{angle}": apart}
    return found


def compare_laws(run: Run, times: pd.DataFrame, efforts: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a law: what settles, how fast, effort, peak, a tick, lost starts, what noise holds."""
    rows, tried, counted = uniform(run), cells.directed_starts(ideal(run)), run.any_rows("costs", **read.FREE_BODY)
    held = in_run(lambda: measured(run.folder).values["held"]) or {}
    for name in families.in_order(times):
        own = rows[rows["contender"] == name]
        yield (
            families.link(name, families.word(name)),
            cells.settles(own),
            cells.seconds(times[name]),
            cells.seconds(times[name], 0.99),
            html.number(float(f"{efforts[name].quantile(interpolation='lower'):.3g}")),
            cells.large(own["peak_u"].max()),
            cells.tick(counted, name),
            cells.count_lost(tried[tried["contender"] == name]),
            html.cell(float(held[name][0])) if name in held else html.MISSING,
        )
