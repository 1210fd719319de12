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


KEPT_SIDE = ("hybrid", "mrp-memory", "rotation-vector-memory", "sliding-memory")
"""Laws that change sides at -DELTA."""

CONSTANTS = (
    Constant("joshi-kelkar-wen", "HARDENING", "γ/Gp", 2.0, (1.25, 1.5, 2.5, 3.0, 4.0)),
    Constant("slew-limited", "SLEW", "greatest rate over Kp/Kv", 1.0, (0.5, 0.7, 1.4, 2.0)),
    # KAPPA |s| must stay below 1, and |s| is 1.1 at most.
    Constant("synergistic", "KAPPA", "κ", 0.3, (0.2, 0.4, 0.6, 0.8)),
    Constant("synergistic", "GAP", "δ", 0.08, (0.02, 0.04, 0.12)),
    # The potential is 2.2 at most and must stay below TOP.
    Constant("synergistic", "TOP", "U₀", 2.4, (2.25, 3.0, 5.0)),
    *(Constant(law, "DELTA", "δ", 0.4, (0.1, 0.2, 0.6)) for law in KEPT_SIDE),
    Constant("mrp-linearized", "SWITCH", "|σ|² at the switch", 1.5, (1.1, 2.0, 3.0)),
    Constant("predicted-side", "MARGIN", "δ", 0.8, (0.4, 1.2)),
    Constant("late-braking", "EASED", "share of the damper", 0.8, (0.6, 0.7, 0.9)),
)


class Varied(NamedTuple):
    """A law with one value of one constant.

    Attributes:
        value: The constant's value.
        ratio: Median over the situations of its 99 % time over that of the default law.
        rank: Its place among all laws by that ratio, 1 the fastest.
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


def median_ratio(times: pd.Series, default_times: pd.Series) -> float:
    """Return the median over situations of a law's time over the default's, of situations where the default settles."""
    settles = default_times[np.isfinite(default_times)]
    return float((times.loc[settles.index] / settles).median())


def shipped_ratios(rows: pd.DataFrame, default: str) -> dict[str, float]:
    """Return the median ratio of every law as shipped."""
    shipped = rows[rows["constant"] == AS_SHIPPED]
    times = {str(law): own.set_index("situation")["time"] for law, own in shipped.groupby("regulator", observed=True)}
    return {law: median_ratio(own, times[default]) for law, own in times.items()}


def vary(constant: Constant, rows: pd.DataFrame, default: str) -> list[Varied]:
    """Return what each value of a constant does, the shipped one among them, in the order of the values."""
    ratios = shipped_ratios(rows, default)
    shipped = rows[rows["constant"] == AS_SHIPPED]
    default_times = shipped[shipped["regulator"] == default].set_index("situation")["time"]
    of_law = rows[rows["regulator"] == constant.law]
    others = [ratio for law, ratio in ratios.items() if law != constant.law]
    found = []
    for value in sorted((constant.shipped, *constant.others)):
        is_shipped = value == constant.shipped
        changed = of_law[(of_law["constant"] == constant.name) & (of_law["value"] == value)]
        own = of_law[of_law["constant"] == AS_SHIPPED] if is_shipped else changed
        ratio = median_ratio(own.set_index("situation")["time"], default_times)
        rank = 1 + sum(other < ratio for other in others)
        found.append(Varied(value, ratio, rank, int(own["lost"].sum())))
    return found


def describe(constant: Constant, every: list[Varied]) -> str:
    """Say within what ratios and ranks a law lies for the values of a constant that were tried."""
    ratios, ranks = [one.ratio for one in every], [one.rank for one in every]
    low, high = min(one.value for one in every), max(one.value for one in every)
    span = f"{constant.law} with {constant.name} from {low:g} to {high:g} takes"
    slowest = f"{max(ratios):.2f}" if math.isfinite(max(ratios)) else "infinitely many"
    times = f"{min(ratios):.2f} to {slowest} times as long as the default law"
    if min(ranks) == max(ranks):
        return f"{span} {times}; its rank is {min(ranks)} for each of these values."
    return f"{span} {times}; its rank is between {min(ranks)} and {max(ranks)}: one value does not rank the law."
