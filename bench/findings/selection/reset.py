"""What it changes to reset a law's memory when the goal jumps: the way, and the time.

Two runs of the same starts are compared, with the memory kept (`goal-jump`) and reset (`goal-jump-reset`).
"""

from typing import NamedTuple

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.statistics import quantile
from bench.findings.perturbed import DETOUR, FAR_RAD
from bench.findings.perturbed import studied as read_study

KEPT, RESET = "goal-jump", "goal-jump-reset"

SOON_S = 0.2
"""Latest jump that finds the body far from its first goal [s]: two time constants 1/10 s."""


class MemorySide(NamedTuple):
    """Jumps with the memory kept, or with it reset. starts: of all levels up to SOON_S.

    far: starts more than FAR_RAD from the new goal. long: of these, paths over DETOUR times the angle at the jump.
    median_s: least and greatest median settling time of a level [s].
    """

    starts: int
    far: int
    long: int
    median_s: tuple[float, float]

    @property
    def long_percent(self) -> float:
        """The share of long paths [%]."""
        return 100.0 * self.long / self.far


class Resets(NamedTuple):
    """A law's jumps over hundreds of starts a level (results/robustness)."""

    kept: MemorySide
    reset: MemorySide


class ResetPairs(NamedTuple):
    """Starts of a run with the memory kept, and the same starts with it reset. differ: pairs whose times differ.

    later: of these, pairs in which the reset settles later; shorter: in which its path is shorter. delay_s: the median
    of the time by which the reset settles later where the two differ [s].
    """

    pairs: int
    differ: int
    later: int
    shorter: int
    delay_s: float


def study_resets(law: str) -> Resets:
    """Return what a reset changes by the study of perturbations."""
    rows = read_study()
    rows = rows[(rows["contender"] == law) & (rows["level"] > 0.0) & (rows["level"] <= SOON_S)]
    return Resets(*(_side(rows[rows["axis"] == axis]) for axis in (KEPT, RESET)))


def _side(rows: pd.DataFrame) -> MemorySide:
    times = rows["median_s"]
    return MemorySide(
        int(rows["starts"].sum()),
        int(rows["far"].sum()),
        int(rows["long"].sum()),
        (float(times.min()), float(times.max())),
    )


def pair_resets(rows: pd.DataFrame, law: str) -> ResetPairs:
    """Return what a reset changes start by start; rows: of robustness.parquet with `contender`."""
    rows = rows[(rows["contender"] == law) & (rows["level"] > 0.0) & (rows["level"] <= SOON_S)]
    rows = rows.assign(time=rows["settling_time_s"].where(rows["outcome"] == "settled", np.inf))
    key = ["level", "start_id"]
    kept, reset = (rows[rows["axis"] == axis].set_index(key)[["time", "path_ratio"]] for axis in (KEPT, RESET))
    both = kept.merge(reset, left_index=True, right_index=True, suffixes=("_kept", "_reset"), validate="one_to_one")
    differing = both[both["time_kept"] != both["time_reset"]]
    delays = (differing["time_reset"] - differing["time_kept"]).to_numpy()
    return ResetPairs(
        len(both),
        len(differing),
        int((delays > 0.0).sum()),
        int((differing["path_ratio_reset"] < differing["path_ratio_kept"]).sum()),
        float(quantile(delays, 0.5)) if len(delays) else 0.0,
    )


def describe_resets(law: str) -> str:
    """Say what a reset buys in way and costs in time, and advise by what matters."""
    kept, reset = study_resets(law)
    return (
        f"If the goal jumps within the first {SOON_S:g} s, a reset of the memory makes long paths rarer. "
        f"With the reset, {reset.long_percent:.1f} % of the paths are longer than {DETOUR:g} times the "
        f"shortest path. Without the reset, this share is {kept.long_percent:.1f} %. Both are shares of the "
        f"{kept.far} jumps to a goal more than {FAR_RAD:g} rad away. The reset does not save time: the median "
        f"settling time is {_range(reset)} s with the reset and {_range(kept)} s without the reset. Reset "
        "the memory if a short path matters; keep the memory if time matters."
    )


def _range(side: MemorySide) -> str:
    low, high = (f"{time:.3f}" for time in side.median_s)
    return low if low == high else f"{low} to {high}"
