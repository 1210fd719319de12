"""Arms and coordinates by name and look."""

from __future__ import annotations

import pandas as pd

import tasks
from bench.law.contenders.registry import contenders
from report.figures.kit import style

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


def short_title(name: str) -> str:
    """How coordinates are called at the head of a column."""
    return contenders("representations")[name].title.removesuffix(" angles")
