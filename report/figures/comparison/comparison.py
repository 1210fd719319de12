"""The page that compares all laws: on the same uniform starts, at the same gains and at the same peak command."""

import functools
import math

import numpy as np
import pandas as pd

from bench.experiments.tables import read
from bench.findings.selection.measured import measured
from report.figures.comparison import cells
from report.figures.kit import families, html
from report.figures.kit.page import Run, in_run

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
    """Return the numbers in the sentences of the page."""
    return of_all(uniform(run), cells.directed_starts(ideal(run)))


def of_all(rows: pd.DataFrame, tried: pd.DataFrame) -> dict:
    """Return the numbers of the laws that are not negative controls.

    Args:
        rows: of `uniform`. tried: of `cells.directed_starts`.
    """
    times, efforts = cells.costs(rows, "settling_time_s"), cells.costs(rows, "effort")
    laws = [name for name in times if name not in families.CONTROLS]
    middle, spent = cells.medians(times[laws]), cells.medians(efforts[laws])
    left = [name for name in cells.leaving_all(tried) if name not in families.CONTROLS]
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
        "left": len(left),
        "directed": int(tried.groupby("contender", observed=True).size().max()),
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


def tables(run: Run) -> dict:
    """Return all laws."""
    return {"all_laws": all_laws(run)}


def all_laws(run: Run) -> html.Markdown | None:
    """Return a row a law: what settles, how fast, effort, peak, lost starts, what noise holds."""
    rows, tried, counted = uniform(run), cells.directed_starts(ideal(run)), run.any_rows("costs", **read.FREE_BODY)
    held = in_run(lambda: measured(run.folder).values["held"]) or {}
    times, efforts = cells.costs(rows, "settling_time_s"), cells.costs(rows, "effort")

    def line(name: str) -> dict:
        own = rows[rows["contender"] == name]
        return {
            "Settles [%]": cells.settles(own),
            "Median [s]": cells.seconds(times[name]),
            "99 % [s]": cells.seconds(times[name], 0.99),
            "Effort": html.number(float(f"{cells.quantile(efforts[name].to_numpy(), 0.5):.3g}")),
            "Peak": cells.large(own["peak_u"].max()),
            "A tick": cells.tick(counted, name),
            "Lost": cells.count_lost(tried[tried["contender"] == name]),
            "Held": html.cell(float(held[name][0])) if name in held else html.MISSING,
        }

    return cells.by_law(times, line)
