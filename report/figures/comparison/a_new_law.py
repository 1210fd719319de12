"""The page on the law that brakes late: how slow, strong and dear it is."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.experiments.tables import read
from bench.findings.theory.closed_form import linear_settling
from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, settling
from bench.law.display import Equation
from bench.law.inputs import PAPERS_GAINS
from report.figures.comparison import cells, comparison
from report.figures.comparison.cells import LEVEL
from report.figures.cost.operations import CALLS
from report.figures.kit import families
from report.figures.kit.page import Run, in_run
from tasks.rules import RULES

NEW = "late-braking"
RATIOS = 0.5, 0.7, 1.0, 1.5
"""Damping ratios at which it is compared with a linear system."""

LATE = EQUATIONS[NEW]


def facts(run: Run) -> dict:
    """Return by the equations how slow and strong this law is against the straight spring; and operations a tick."""
    counted = run.any_rows("costs", **read.FREE_BODY)
    spent = counted[counted["stage"] == "total"].set_index(["contender", "branch"])
    return {
        "at_peak": in_run(lambda: compare_at_equal_peak(comparison.at_peak(run))),
        "slowest": f"{longest(LATE, *PAPERS_GAINS):.3f}",
        "linear": f"{linear_settling(*PAPERS_GAINS):.3f}",
        "later": ", ".join(f"{ratio:g}" for ratio in RATIOS if is_later(ratio)) or "none",
        "later_of": f"{', '.join(map('{:g}'.format, RATIOS))}",
        **(count_calls(spent.loc[NEW, "typical"]) if (NEW, "typical") in spent.index else {}),
        "pull": f"{greatest_pull(LATE):.2f}",
    }


def compare_at_equal_peak(rows: pd.DataFrame) -> str:
    """Count the published laws that are as fast as this one, or spend as little, with gains for one peak command."""
    times, efforts = cells.costs(rows, "settling_time_s"), cells.costs(rows, "effort")
    others = [law for law in times if law != NEW and law not in families.CONTROLS]
    measures = {
        "median settling time": cells.medians(times),
        "slowest start": times.max(),
        "median effort": cells.medians(efforts),
    }
    units = ("s", "s", "rad²/s³")
    parts = [
        f"{name} {own[NEW]:.3g} {unit} ({(own[others] <= own[NEW]).sum()} of {len(others)} published laws need no more)"
        for (name, own), unit in zip(measures.items(), units, strict=True)
    ]
    return f"With gains that give every law a peak command of {LEVEL:g} rad/s² from rest: {'; '.join(parts)}."


def is_later(ratio: float) -> bool:
    """Tell whether this law's slowest start settles a millisecond later than a linear system of this damping ratio."""
    kp = PAPERS_GAINS[0]
    kv = 2.0 * ratio * math.sqrt(kp)
    return longest(LATE, kp, kv) > linear_settling(kp, kv) + 1e-3


def count_calls(row: pd.Series) -> dict[str, int]:
    """Return the flops, the square roots and the trigonometric calls of a row of costs.parquet."""
    return {"flops": int(row["flops"]), "roots": int(row["sqrt"]), "calls": int(row[list(CALLS)].sum())}


def longest(equation: Equation, kp: float, kv: float) -> float:
    """Return the longest settling time [s] from rest, over angles up to 180°."""
    return max(settling(equation, angle, kp, kv, RULES.tolerance) for angle in np.linspace(LEAST_RAD, math.pi, 24))


def greatest_pull(equation: Equation) -> float:
    """max f: the greatest command from rest, over Kp."""
    return max(map(equation.spring, np.linspace(0.0, math.pi, 1801)))
