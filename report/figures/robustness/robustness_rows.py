"""Episodes in trouble as the pages read them: an axis's rows, laws family by family, and whether each went well.

It went well if it settled. Where trouble goes on after the goal is reached, and the angle's own 2 % say nothing, it
went well if over the last second the root mean square angle to the goal is at most HELD_RAD.
"""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

import tasks
from report.figures.kit import absent, families
from tasks.condition import Axis

HELD_RAD = math.radians(3.0)
LASTING = ("attitude-noise", "rate-noise", "moving-goal", "moving-goal-rate", "moving-goal-untold")
"""Axes whose trouble goes on."""


def along(name: str) -> pd.DataFrame:
    """Rows of one axis, laws family by family, with `good` and `time_s`, which is infinite where nothing settled.

    None of a run that was in no trouble.
    """
    rows = absent.robustness(axis=name)
    if rows.empty:
        return rows
    settled = rows["outcome"] == "settled"
    good = rows["tail_rms_rad"] <= HELD_RAD if name in LASTING else settled
    names = families.in_order(rows["contender"].unique())
    return rows.assign(
        contender=pd.Categorical(rows["contender"].astype(str), names, ordered=True),
        good=good,
        time_s=rows["settling_time_s"].where(settled, np.inf),
    )


def laws(rows: pd.DataFrame) -> list[str]:
    """The laws of the rows, family by family."""
    return [name for name in rows["contender"].cat.categories if (rows["contender"] == name).any()]


def of(rows: pd.DataFrame, law: str, level: float | None = None) -> pd.DataFrame:
    """Rows of one law, or of one law at one level."""
    own = rows[rows["contender"] == law]
    return own if level is None else own[own["level"] == level]


def gains(rows: pd.DataFrame) -> tuple[float, float]:
    """(kp, kv) of the rows."""
    return float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])


def levels(rows: pd.DataFrame) -> list[float]:
    """The levels that the rows hold, from the least."""
    return sorted(rows["level"].unique())


def nominal(axis: Axis) -> float:
    """The level of no trouble; of an axis that has none, its mildest: the largest bound."""
    return max(axis.levels) if axis.nominal is None else axis.nominal


def worst(rows: pd.DataFrame, name: str) -> float:
    """The level most levels away from the nominal one; of two such the greater."""
    there = levels(rows)
    place = there.index(nominal(tasks.axis(name)))
    return there[0] if place > len(there) - 1 - place else there[-1]


def said(level: float, name: str) -> str:
    """A level with its unit, in a unit that suits it."""
    unit = tasks.axis(name).unit
    if unit == "s":
        return f"{1000.0 * level:g} ms"
    if unit == "Hz" and level >= 1000.0:
        return f"{level / 1000.0:g} kHz"
    return f"{level:g}" if unit == "1" else f"{level:g} {unit.replace('^2', '²')}"


def plain(level: float) -> str:
    """A level alone, thousands as k."""
    if level >= 1000.0:
        return f"{level / 1000.0:g}k"
    return f"{level:g}"
