"""What the constants that are ours do to a law's rank: the rows of results/constants, read.

A law of a family is not the family. Where a constant of a law is ours, its settling time is compared with that of the
default law for every value that was tried, and its rank among all laws of the map is counted again for each value.
"""

import functools
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read

STUDY = RESULTS / "constants"
"""What `python -P -m bench.studies.constants` keeps."""

NOTABLE = 0.01
"""Differences below a hundredth are no reason to choose a law."""

AS_SHIPPED = "as shipped"


class Constant(NamedTuple):
    """A constant of ours in a law's file.

    Attributes:
        law: The law's name.
        name: Name of the constant in its file.
        symbol: What a formula calls it.
        shipped: Its value in the file.
        others: Further values that are tried.
    """

    law: str
    name: str
    symbol: str
    shipped: float
    others: tuple[float, ...]


KEPT_SIDE = (
    "hybrid",
    "mrp-memory",
    "rotation-vector-memory",
    "sliding-memory",
    "braking-cascade-memory",
    "wie-bailey-heiberg-memory",
    "braking-feedforward",
)
"""Laws that change sides at -DELTA."""

PLANNING = ("braking-cascade", "wie-bailey-heiberg", "braking-feedforward")
"""Laws that plan to brake with a share of the bound."""

SHARE = "a divided by the bound (the share of the bound that the law plans to brake with)"
HARDENING = "γ/Gp (gain of the hardening term, divided by the linear gain)"
SWITCH = "|σ|² at which the law switches to the other MRP vector"

CONSTANTS = (
    Constant("joshi-kelkar-wen", "HARDENING", HARDENING, 2.0, (1.25, 1.5, 2.5, 3.0, 4.0)),
    *(Constant(law, "SHARE", SHARE, 0.7, (0.4, 0.5, 0.6, 0.85, 1.0)) for law in PLANNING),
    # KAPPA |s| must stay below 1, and |s| is 1.1 at most.
    Constant("synergistic", "KAPPA", "κ", 0.3, (0.2, 0.4, 0.6, 0.8)),
    Constant("synergistic", "GAP", "δ", 0.08, (0.02, 0.04, 0.12)),
    # The potential is 2.2 at most and must stay below TOP.
    Constant("synergistic", "TOP", "U₀", 2.4, (2.25, 3.0, 5.0)),
    *(Constant(law, "DELTA", "δ", 0.4, (0.1, 0.2, 0.6)) for law in KEPT_SIDE),
    Constant("mrp-linearized", "SWITCH", SWITCH, 1.5, (1.1, 2.0, 3.0)),
    Constant("late-braking", "EASED", "share of the damping that is removed at 180°", 0.8, (0.6, 0.7, 0.9)),
)


class VariedConstant(NamedTuple):
    """A law with one value of one constant.

    Attributes:
        value: The constant's value.
        ratio: Median over the situations of its 99 % time over that of the default law.
        rank: One more than the number of laws that are faster by that ratio, and by more than NOTABLE.
        lost: Starts that do not settle, of all situations.
    """

    value: float
    ratio: float
    rank: int
    lost: int


@functools.cache
def read_rows(folder: Path = STUDY) -> pd.DataFrame:
    """Return the rows of the study."""
    return read(folder, "constants")


def median_ratio(times: pd.Series, beside: pd.Series) -> float:
    """Return the median over situations of a law's time over the default's, of situations where the default settles."""
    settles = beside[np.isfinite(beside)]
    return float((times.loc[settles.index] / settles).median())


def shipped_ratios(rows: pd.DataFrame, default: str) -> dict[str, float]:
    """Return the median ratio of every law as shipped."""
    shipped = rows[rows["constant"] == AS_SHIPPED]
    beside = default_times(rows, default)
    return {
        str(law): median_ratio(own.set_index("situation")["time"], beside)
        for law, own in shipped.groupby("regulator", observed=True)
    }


def default_times(rows: pd.DataFrame, default: str) -> pd.Series:
    """Return the 99 % time of the default law as shipped, by situation; infinite where it loses a hundredth."""
    of_default = rows[(rows["constant"] == AS_SHIPPED) & (rows["regulator"] == default)]
    return of_default.set_index("situation")["time"]


def vary(constant: Constant, rows: pd.DataFrame, default: str) -> list[VariedConstant]:
    """Return what each value of a constant does, the shipped one among them, in the order of the values."""
    ratios = shipped_ratios(rows, default)
    beside = default_times(rows, default)
    of_law = rows[rows["regulator"] == constant.law]
    others = [ratio for law, ratio in ratios.items() if law != constant.law]
    found = []
    for value in sorted((constant.shipped, *constant.others)):
        is_shipped = value == constant.shipped
        changed = of_law[(of_law["constant"] == constant.name) & (of_law["value"] == value)]
        own = of_law[of_law["constant"] == AS_SHIPPED] if is_shipped else changed
        ratio = median_ratio(own.set_index("situation")["time"], beside)
        # Ratios within NOTABLE of each other are ties.
        rank = 1 + sum(other < (1.0 - NOTABLE) * ratio for other in others)
        found.append(VariedConstant(value, ratio, rank, int(own["lost"].sum())))
    return found


def describe(constant: Constant, every: list[VariedConstant], default: str) -> str:
    """Say within what ratios and ranks a law lies for the values of a constant that were tried."""
    ratios, ranks = [one.ratio for one in every], [one.rank for one in every]
    low, high = min(one.value for one in every), max(one.value for one in every)
    slowest = f"{max(ratios):.2f}" if math.isfinite(max(ratios)) else "infinitely many"
    fastest = f"{min(ratios):.2f}"
    times = fastest if fastest == slowest else f"{fastest} to {slowest}"
    said = (
        f"With {constant.name} from {low:g} to {high:g}, {constant.law} takes {times} times as "
        f"long as {default} (median over the situations)."
    )
    if min(ranks) == max(ranks):
        return f"{said} Its rank among the laws of the map is {min(ranks)} for each of these values."
    return (
        f"{said} Its rank among the laws of the map is between {min(ranks)} and {max(ranks)}, so "
        "that one value does not rank a family of laws."
    )
