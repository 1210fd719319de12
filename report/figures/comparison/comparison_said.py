"""The numbers in the sentences of the comparison."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.tables.statistics import quantile
from report.figures.comparison import comparison_dead
from report.figures.comparison.comparison_rows import DETOUR, costs
from report.figures.comparison.comparison_tables import percent
from report.figures.kit import families, html

LITERAL, UNWINDING = "linearized-euler-literal/zyx-euler", "quaternion-unwinding"


def facts(rows: pd.DataFrame, directed: pd.DataFrame) -> dict:
    """Of what is compared, and of the laws that are no negative controls.

    Args:
        rows: of `comparison_rows.common`. directed: of `comparison_dead.directed`.
    """
    times, efforts = costs(rows, "settling_time_s"), costs(rows, "effort")
    laws = [name for name in times if name not in families.CONTROLS]
    medians, spent = (
        pd.Series({name: float(quantile(table[name].to_numpy(), 0.5)) for name in laws}) for table in (times, efforts)
    )
    whole = [name for name in laws if np.isfinite(times[name]).all()]
    slowest = pd.Series({name: times[name].max() for name in whole})
    left = [name for name in comparison_dead.left(directed) if name not in families.CONTROLS]
    return {
        "laws": len(laws),
        "starts": len(times),
        "kp": float(rows["kp"].iloc[0]),
        "kv": float(rows["kv"].iloc[0]),
        "band": f"{100 * float(rows['tolerance'].iloc[0]):g}",
        "tick": f"{1000 * float(rows['dt_s'].iloc[0]):g}",
        "detour": DETOUR,
        "fastest": families.word(medians.idxmin()),
        "fastest_s": f"{medians.min():.2f}",
        "slowest": families.word(medians.idxmax()),
        "slowest_s": f"{medians.max():.2f}",
        "whole": len(whole),
        "surest": families.word(slowest.idxmin()),
        "surest_s": f"{slowest.min():.2f}",
        "sparest": families.word(spent.idxmin()),
        "dearest": families.word(spent.idxmax()),
        "dearer": f"{spent.max() / spent.min():.0f}",
        "left": len(left),
        "left_laws": ", ".join(map(families.word, left)),
        "directed": len(directed) // directed["contender"].nunique(),
    }


def controls(rows: pd.DataFrame) -> dict:
    """That the negative controls fail, and how; a dash for one that is not in the run."""
    literal, unwinding = (rows[rows["contender"] == name] for name in (LITERAL, UNWINDING))
    found: dict = dict.fromkeys(("literal_settled", "literal_n", "unwound", "unwound_settled", "longest"), html.MISSING)
    if len(literal):
        found |= {"literal_settled": int((literal["outcome"] == "settled").sum()), "literal_n": len(literal)}
    if len(unwinding):
        travelled = np.degrees(unwinding["path_ratio"] * unwinding["angle0_rad"])
        found |= {
            "unwound": percent(float((unwinding["path_ratio"] > DETOUR).mean())),
            "unwound_settled": percent(float((unwinding["outcome"] == "settled").mean())),
            "longest": f"{travelled.max():.0f}",
        }
    return found
