"""Laws of a situation compared start by start: how the ratio of two laws' 99 % times varies with the starts.

All laws of a situation run the same starts, drawn independently. A hard start is hard for both laws of a pair, so that
the ratio of their times varies less than the two times do, and the intervals of the two times alone cannot tell laws
apart that their common starts do.
"""

import functools
import itertools
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bench.experiments.situations import CROWD, summarize
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.statistics import TAIL, quantile, resampled, resampled_quantile
from bench.experiments.tables.store import read

NUMBERS = ("log_ratio", "error", "low", "high")
"""The columns of pairs.parquet that are numbers of seven digits."""


def read_run(folder: Path) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return the rows of situations.parquet and of pairs.parquet that the starts of a run make."""
    starts = read(folder, "settling")
    return summarize(starts), compare_laws(starts)


@functools.cache
def read_all_pairs(folder: Path) -> pd.DataFrame:
    """Return the rows of a map's pairs.parquet."""
    pairs = read(folder, "pairs")
    # A number of seven digits would be compared with a limit that is rounded to seven digits, too.
    kinds = dict.fromkeys(("situation", "law", "other"), str) | dict.fromkeys(NUMBERS, float)
    return pairs.astype(kinds)


@functools.cache
def read_pairs(folder: Path) -> dict[str, pd.DataFrame]:
    """Return the rows of a map's pairs.parquet by the word of their situation."""
    return {str(word): rows for word, rows in read_all_pairs(folder).groupby("situation")}


@functools.cache
def read_pair_columns(folder: Path) -> dict[str, dict[str, np.ndarray]]:
    """Return the same as columns."""
    return split(read_all_pairs(folder))


def split(rows: pd.DataFrame) -> dict[str, dict[str, np.ndarray]]:
    """Return the columns of the rows of each situation, by its word."""
    columns = columns_of(rows)
    places = rows.groupby("situation", sort=False, observed=True).indices
    return {str(word): {name: values[own] for name, values in columns.items()} for word, own in places.items()}


def columns_of(rows: pd.DataFrame) -> dict[str, np.ndarray]:
    """Return columns as arrays: a look into a frame takes longer than to decide on forty laws."""
    return {str(name): np.asarray(rows[name]) for name in rows}


@functools.cache
def compare_with_all(law: str, folder: Path) -> pd.DataFrame:
    """Return a row for each situation and other law (`rival`): the ratio of the law's 99 % time to the rival's.

    A log_ratio above 0 says that the rival is faster.
    """
    pairs = read_all_pairs(folder)
    divided = pairs[pairs["law"] == law].rename(columns={"other": "rival"}).drop(columns="law")
    divisor = pairs[pairs["other"] == law].rename(columns={"law": "rival"}).drop(columns="other")
    swapped = divisor.assign(
        log_ratio=-divisor["log_ratio"],
        low=-divisor["high"],
        high=-divisor["low"],
    )
    return pd.concat([divided, swapped], ignore_index=True)


def compare_laws(starts: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of pairs.parquet of the starts of settling.parquet, every two laws of every situation."""
    drawn = with_contender(starts[starts["start_set"] == "drawn"])
    found = []
    for word, rows in drawn.groupby("situation", sort=False, observed=True):
        times = {
            str(law): rows_of_law.sort_values("start")["time"].to_numpy()
            for law, rows_of_law in rows.groupby("contender", observed=True)
        }
        found += [{"situation": str(word), **pair} for pair in compare_times(times)]
    columns = ["situation", "law", "other", "starts", *NUMBERS]
    # Rounded as the file keeps them, so that a run decides as its file does.
    return pd.DataFrame(found, columns=columns).astype(dict.fromkeys(NUMBERS, np.float32))


def compare_times(times: dict[str, np.ndarray]) -> list[dict]:
    """Return a pair for every two laws, by their 99 % times; times: of each law, as `compare_values` takes them."""
    of_crowd = functools.partial(quantile, level=CROWD)
    return compare_values(times, of_crowd, functools.partial(resampled_quantile, level=CROWD))


def compare_shares(is_missed: dict[str, np.ndarray]) -> list[dict]:
    """Return a pair for every two laws, by the share of their starts that miss."""
    return compare_values(is_missed, np.mean, functools.partial(resampled, statistic=np.mean))


def compare_values(
    values: dict[str, np.ndarray],
    number: Callable[[np.ndarray], Any],
    resampled_number: Callable[[np.ndarray], np.ndarray],
) -> list[dict]:
    """Return a pair for every two laws; values: of each law, of the same starts in the same order, some of fewer.

    number, resampled_number: what is compared, of a law's values and of each resample of them. The paired bootstrap: a
    resample draws starts, and both numbers are of the starts that it drew (B. Efron, Ann. Stat. 7, 1979). They are the
    same for every pair of equally many starts, and are therefore computed once.
    """
    counts = sorted({len(values_of_law) for values_of_law in values.values()})
    logarithms = {}
    for law, values_of_law in values.items():
        for count in counts:
            if count <= len(values_of_law):
                first = values_of_law[:count]
                with np.errstate(divide="ignore"):
                    logarithms[law, count] = np.log(number(first)), np.log(resampled_number(first))
    found = []
    for law, other in itertools.combinations(sorted(values), 2):
        count = min(len(values[law]), len(values[other]))
        (time, resampled), (other_time, other_resampled) = logarithms[law, count], logarithms[other, count]
        if np.isinf(time) and np.isinf(other_time):
            continue
        with np.errstate(invalid="ignore"):
            # Where neither law settles in a resample there is no difference.
            ratios = np.nan_to_num(resampled - other_resampled, nan=0.0, posinf=np.inf, neginf=-np.inf)
        found.append(
            {
                "law": law,
                "other": other,
                "starts": count,
                "log_ratio": time - other_time,
                "error": ratios.std() if np.isfinite(ratios).all() else np.nan,
                "low": quantile(ratios, TAIL),
                "high": quantile(ratios, 1.0 - TAIL),
            }
        )
    return found


def find_slower(pairs: Mapping[Any, Any], laws: Sequence[str], tie: float) -> np.ndarray:
    """Return whether the 99 % time of law i is notably longer than that of law j, shape (n, n).

    Notably: law j needs less than 1 - `tie` of the time of law i, and the paired 95 % interval of the ratio excludes 1.
    """
    place = {law: number for number, law in enumerate(laws)}
    sides = [np.asarray(pairs[column], dtype=object) for column in ("law", "other")]
    first, second = (np.array([place.get(law, -1) for law in side], dtype=int) for side in sides)
    both = (first >= 0) & (second >= 0)
    first, second = first[both], second[both]
    ratio, low, high = (np.asarray(pairs[column], dtype=float)[both] for column in ("log_ratio", "low", "high"))
    notable = -np.log1p(-tie)
    is_slower = np.zeros((len(place), len(place)), dtype=bool)
    is_slower[first, second] = (ratio > notable) & (low > 0.0)
    is_slower[second, first] = (ratio < -notable) & (high < 0.0)
    return is_slower
