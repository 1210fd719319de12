"""How the pages on Jacobians show poses: arms and coordinates by name and look, how singularities are told apart."""

from __future__ import annotations

import numpy as np
import pandas as pd

import tasks
from bench.contenders.registry import known_representations, papers_coordinates
from report.figures.kit import style

PAPERS = papers_coordinates().name

BAD = 100.0
"""Condition number (metres, radians) from which on maps and tables call a Jacobian bad: twice what the claims allow."""

NEAR = 0.1
"""Margin of the coordinates below which a pose counts as near their singularity; of Z-Y-X angles 5.7 deg of beta."""

LOOKS = {
    "puma560": style.Look("#d55e00", "s", style.DASHED),
    "ur5e": style.Look("#0072b2", "o", style.SOLID),
    "panda": style.Look("#009e73", "^", style.DASH_DOT),
    "jaco": style.Look("#cc79a7", "D", style.DOTTED),
}


def arms(rows: pd.DataFrame) -> list[str]:
    """Names of the arms that the rows are about, the paper's own first."""
    there = set(rows["arm"].astype(str))
    return [name for name in LOOKS if name in there] + sorted(there - set(LOOKS))


def title(arm: str) -> str:
    """How an arm is called."""
    return tasks.arm(arm).title if arm in tasks.arm_names() else arm


def look(arm: str) -> style.Look:
    """How an arm is drawn."""
    return LOOKS.get(arm) or style.look(arm)


def look_of_coordinates(name: str) -> style.Look:
    """How the Jacobian of these coordinates is drawn."""
    return style.look_of_coordinates(name)


def short_title(name: str) -> str:
    """How coordinates are called at the head of a column."""
    return known_representations()[name].title.removesuffix(" angles")


def share(found: pd.Series) -> float:
    """How many of the rows it is true of; NaN of none."""
    return float(found.mean()) if len(found) else float("nan")


def finite(values: pd.Series, ceiling: float) -> np.ndarray:
    """Values for a logarithmic axis: what is infinite or beyond stands at the ceiling."""
    return np.minimum(np.nan_to_num(values.to_numpy(dtype=float), nan=ceiling, posinf=ceiling), ceiling)
