"""What the comparison compares: the same uniform starts of every law on the continuous plant, and what each took."""

from __future__ import annotations

import numpy as np
import pandas as pd

from report.figures.kit import families

DETOUR = 1.5
"""Path over shortest path from which a start is a detour; about one fixed axis only the long way round is one."""


def common(episodes: pd.DataFrame) -> pd.DataFrame:
    """Rows of uniform starts that every law ran, so that none is judged by easier ones; laws family by family.

    Args:
        episodes: rows of one engine. The paper's laws ran more starts than the later ones.
    """
    uniform = episodes[(episodes["start_set"] == "uniform") & (episodes["arm"] == "")]
    ran = uniform.groupby("start_id", observed=True)["contender"].nunique()
    return in_families(uniform[uniform["start_id"].isin(ran.index[ran == uniform["contender"].nunique()])])


def in_families(rows: pd.DataFrame) -> pd.DataFrame:
    """The rows with their laws family by family."""
    names = families.in_order(rows["contender"].unique())
    ordered = rows.assign(contender=pd.Categorical(rows["contender"].astype(str), names, ordered=True))
    return ordered.sort_values(["contender", "start_id"]).reset_index(drop=True)


def costs(rows: pd.DataFrame, column: str) -> pd.DataFrame:
    """A column by start and law, infinite where the law did not settle: shape (starts, laws)."""
    settled = rows["outcome"] == "settled"
    return rows.assign(cost=rows[column].where(settled, np.inf)).pivot(
        index="start_id", columns="contender", values="cost"
    )


NEAR_AXIS, NEAR_PLANE = float(np.cos(np.radians(30.0))), float(np.sin(np.radians(15.0)))
"""Within 30 degrees of an axis, within 15 degrees of a plane of two."""


def axis_words(start: pd.Series) -> str:
    """Where the axis of a start's rotation lies: near one of the base's axes, or between them."""
    axis = np.abs(start[["quat_x", "quat_y", "quat_z"]].to_numpy(float))
    parts = axis / np.linalg.norm(axis)
    if parts.max() > NEAR_AXIS:
        return f"near {'xyz'[int(parts.argmax())]}"
    if parts.min() < NEAR_PLANE:
        one, other = np.delete(list("xyz"), int(parts.argmin()))
        return f"between {one} and {other}"
    return "between all three"
