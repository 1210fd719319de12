"""Directed starts: 180° rotations, poles and jumps of coordinates, which uniform starts never hit, and beside them."""

from __future__ import annotations

import pandas as pd
from scipy.spatial.transform import Rotation

from bench.experiments.tables.read import converged
from bench.findings.start_sets import AT_REST
from report.figures.kit import families


def directed(episodes: pd.DataFrame) -> pd.DataFrame:
    """Directed starts at rest, each orientation once a law, though several sets have it; rows of one engine."""
    rows = episodes[episodes["start_set"].isin(AT_REST) & (episodes["arm"] == "")]
    return rows[~orientation(rows).assign(contender=rows["contender"]).duplicated()]


def orientation(rows: pd.DataFrame) -> pd.DataFrame:
    """R, which both quaternions of an orientation share, to the last digit but three."""
    turns = Rotation.from_quat(rows[["quat_w", "quat_x", "quat_y", "quat_z"]].to_numpy(), scalar_first=True)
    return pd.DataFrame(turns.as_matrix().reshape(-1, 9).round(13), rows.index)


def count_lost(rows: pd.DataFrame) -> str:
    """Return how many of a law's starts that converge do not settle: 26 of 726."""
    sure = converged(rows)
    return f"{int((sure['outcome'] != 'settled').sum())} of {len(sure)}"


def left(rows: pd.DataFrame) -> list[str]:
    """Return the laws that leave every directed start, family by family."""
    failed = set(rows.loc[rows["outcome"] != "settled", "contender"])
    return [name for name in families.in_order(rows["contender"].unique()) if name not in failed]
