"""What laws are compared by: the starts that all ran, and numbers of a law's rows as a table's cells."""

from collections.abc import Callable

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from bench.experiments.tables.read import converged
from bench.experiments.tables.statistics import Estimate, quantile_estimate
from bench.findings.claims.tables import share
from bench.findings.selection import tables
from bench.findings.start_sets import AT_REST
from report.figures.cost.cost import totals
from report.figures.cost.operations import CALLS
from report.figures.kit import families, html
from report.figures.kit.spelling import power

NEVER = "never"
SMALL_PEAK = 1e4
"""Commands [rad/s^2] above this are those of a division by nearly nothing."""


def common(episodes: pd.DataFrame) -> pd.DataFrame:
    """Rows of uniform starts that every law ran, so that none is judged by easier ones; laws family by family.

    Args:
        episodes: rows of one engine. The paper's laws ran more starts than the later ones.
    """
    rows = tables.common(episodes[(episodes["start_set"] == "uniform") & (episodes["arm"] == "")])
    names = families.in_order(rows["contender"].unique())
    ordered = rows.assign(contender=pd.Categorical(rows["contender"].astype(str), names, ordered=True))
    return ordered.sort_values(["contender", "start_id"], ignore_index=True)


def costs(rows: pd.DataFrame, column: str) -> pd.DataFrame:
    """Return a column by start and law, infinite where the law did not settle: shape (starts, laws)."""
    settled = rows["outcome"] == "settled"
    return rows.assign(cost=rows[column].where(settled, np.inf)).pivot(
        index="start_id", columns="contender", values="cost"
    )


def settles(own: pd.DataFrame) -> str:
    """Return the share of a law's rows that settle [%], with its interval."""
    found = share(own["outcome"] == "settled")
    return with_interval(*map(percent, (found.value, found.low, found.high)))


def tick(counted: pd.DataFrame, name: str) -> str:
    """Return flops and calls of a typical tick, as "45 + 6".

    Args:
        counted: rows of costs.parquet about the free body.
    """
    if name not in set(counted["contender"]):
        return html.MISSING
    own = totals(counted).loc[name]
    flops, calls = int(own["flops"]), int(own[list(CALLS)].sum())
    return f"{flops} + {calls}" if calls else (f"{flops}" if flops else html.MISSING)


def percent(part: float) -> str:
    """Return a share in per cent, to a tenth, whole where it is all or nothing."""
    return f"{100 * part:.0f}" if part in (0.0, 1.0) else f"{100 * part:.1f}"


def seconds(values: pd.Series, level: float = 0.5) -> str:
    """Return a quantile of times with its interval; among the failures it is never reached."""
    return spelled(quantile_estimate(values.to_numpy(), level), lambda value: f"{value:.3f}")


def large(value: float) -> str:
    """Return a number to three figures, or as a power of ten where it stands for no bound."""
    return html.number(float(f"{value:.3g}")) if value < SMALL_PEAK else power(value)


def spelled(found: Estimate, write: Callable[[float], str]) -> str:
    """Return an estimate as words; where both ends are the number itself, the number alone."""
    value, low, high = (write(one) if np.isfinite(one) else NEVER for one in found)
    return value if value == low == high else with_interval(value, low, high)


def with_interval(value: str, low: str, high: str) -> str:
    """Return a number, and its interval, which no line breaks."""
    return f"{value} {html.together(f'({low} to {high})')}"


def directed_starts(episodes: pd.DataFrame) -> pd.DataFrame:
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
