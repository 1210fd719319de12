"""What a map says of laws: the share of starts that are lost, with its interval, and the slowest."""

import functools
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.base.errors import NoTable
from bench.experiments.tables.rows import number_rows
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.statistics import TAIL, Estimate
from bench.experiments.tables.store import read, read_arrow
from bench.law.inputs import Gains

SPEEDS = ["least_speed", "most_speed"]
KEY = ["contender", "kp", "kv", "engine", *SPEEDS]
"""What one count is of."""

NUMBERS = ["starts", "settled", "unconverged"]


def read_maps(folder: Path) -> pd.DataFrame:
    """Return the rows of every map in a folder of maps, a folder each, in the order of their names."""
    frames = [read(path.parent, "map") for path in _list_maps(folder)]
    words = [name for name in frames[0] if isinstance(frames[0][name].dtype, pd.CategoricalDtype)]
    together = pd.concat([frame.astype(dict.fromkeys(words, str)) for frame in frames], ignore_index=True)
    return together.astype(dict.fromkeys(words, "category"))


def _list_maps(folder: Path) -> list[Path]:
    """Return the files of the maps in a folder; NoTable: there is none."""
    paths = sorted(folder.glob("*/map.parquet"))
    if not paths:
        raise NoTable(f"{folder}: there is no map in it; make one with bench map --out {folder}/NAME")
    return paths


def at_gains(rows: pd.DataFrame, gains: Gains) -> pd.DataFrame:
    """Return the rows that were simulated with these gains; there may be none."""
    return rows[(rows["kp"] == gains.kp) & (rows["kv"] == gains.kv)]


@functools.cache
def lost_share(lost: int, of: int) -> Estimate:
    """Return a share with its exact 95 % interval (`exact_interval`)."""
    low, high = exact_interval(np.array(lost), np.array(of))
    return Estimate(lost / of, float(low), float(high))


def exact_interval(counts: np.ndarray, of: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return both ends of the exact 95 % intervals of shares (C. Clopper, E. Pearson, Biometrika 26, 1934).

    With k of n, the lower end is the 2.5 % quantile of the beta distribution with k and n - k + 1, and the upper end
    the 97.5 % quantile of that with k + 1 and n - k. The ends are 0 where k = 0 and 1 where k = n.
    """
    from scipy.special import betaincinv

    rest = of - counts
    low = betaincinv(np.maximum(counts, 1), rest + 1, TAIL)
    high = betaincinv(counts + 1, np.maximum(rest, 1), 1.0 - TAIL)
    return np.where(counts > 0, low, 0.0), np.where(rest > 0, high, 1.0)


def counted(rows: pd.DataFrame) -> pd.DataFrame:
    """How many starts a law, gains and speed have, and how many of them are lost or do not converge.

    Columns: contender, kp, kv, engine, least_speed, most_speed [rad/s], starts, settled, unconverged, lost.
    """
    return _sum(with_contender(rows[rows["row"] == "cell"]))


def _sum(cells: pd.DataFrame) -> pd.DataFrame:
    """Return a row a law, gains, engine and speed: its starts, and how many settle, do not converge, and are lost."""
    first, number = number_rows(cells, KEY)
    sums = {name: np.bincount(number, cells[name], len(first)).astype(int) for name in NUMBERS}
    found = cells[KEY].iloc[first].reset_index(drop=True).assign(**sums)
    return found.assign(lost=found["starts"] - found["settled"] - found["unconverged"])


OF_CELLS = ["regulator", "representation", "row", "kp", "kv", "engine", *SPEEDS]
"""Columns that consecutive cells of one count share."""


def read_cells(path: Path) -> pd.DataFrame:
    """Return the rows of a map's file that stand after one another and share OF_CELLS as one row, NUMBERS summed.

    A map has a million rows, and a law's cells stand together: so only a few thousand rows become a data frame.
    """
    table = read_arrow(path, "map", [*OF_CELLS, *NUMBERS])
    if any(column.num_chunks != 1 for column in table.columns):
        table = table.unify_dictionaries().combine_chunks()
    columns = {name: table.column(name).chunk(0) for name in table.column_names}
    is_first = np.zeros(table.num_rows, dtype=bool)
    is_first[:1] = True
    for name in OF_CELLS:
        column = columns[name]
        values = (column.indices if hasattr(column, "indices") else column).to_numpy()
        is_first[1:] |= values[1:] != values[:-1]
    first = is_first.nonzero()[0]
    rows = table.take(first).to_pandas(ignore_metadata=True)
    sums = {name: np.add.reduceat(columns[name].to_numpy(), first) for name in NUMBERS}
    return rows.assign(**sums)


@functools.lru_cache(maxsize=1)
def count_in(folder: Path) -> pd.DataFrame:
    """Return `counted` of the maps in a folder, once for the runs at all gains; NoTable: there is no map."""
    return counted(pd.concat([read_cells(path) for path in _list_maps(folder)], ignore_index=True))


def lost_between(lost: int, unconverged: int, of: int) -> Estimate:
    """Return the share lost of those that converge, and its exact 95 % interval, whose upper end counts the others."""
    value = lost / (of - unconverged) if of > unconverged else math.nan
    return Estimate(value, lost_share(lost, of).low, lost_share(lost + unconverged, of).high)


def by_law(rows: pd.DataFrame) -> pd.DataFrame:
    """Return a row a law, gains and speed: starts that converge and are lost, in ppm with interval, and the slowest."""
    key = KEY
    slowest = with_contender(rows[rows["row"] == "slowest"]).sort_values("settling_time_s")
    last = slowest.drop_duplicates(key, keep="last")[[*key, "settling_time_s", "ring_deg"]]
    found = counted(rows).merge(last, how="left", on=key)
    of = found["starts"] - found["unconverged"]
    low, high = exact_interval(found["lost"].to_numpy(), of.to_numpy())
    shares = 1e6 * np.stack([found["lost"] / of, low, high], axis=1)
    return pd.DataFrame(
        {
            "law": found["contender"],
            "speed [rad/s]": [
                f"{most:g}" if least == most else f"{least:g} to {most:g}"  # of all starts, or uniform between both
                for least, most in found[SPEEDS].itertuples(index=False)
            ],
            **{name: found[name] for name in ("starts", "unconverged", "lost")},
            **{f"{head} [ppm]": shares[:, k] for k, head in enumerate(("lost", "least", "most"))},
            "slowest [s]": found["settling_time_s"],
            "from [deg]": found["ring_deg"].fillna(-1).astype(int),
        }
    )


class Spun(NamedTuple):
    """Starts of one law at one stated speed [rad/s]: how many, not converged, and the share lost of `lost_between`."""

    speed: float
    starts: int
    unconverged: int
    share: Estimate


def spun(numbers: pd.DataFrame, law: str, gains: Gains, engine: str) -> list[Spun]:
    """Return a law's starts at stated speeds from what `counted` gives, the slowest first.

    There are none where no map has the law with these gains by this engine: it was not tested then.
    """
    return list_spun(numbers).get((law, gains, engine), [])


def list_spun(numbers: pd.DataFrame) -> dict[tuple[str, Gains, str], list[Spun]]:
    """Return the starts at stated speeds of every law, by law, gains and engine, as `spun` has them."""
    stated = numbers[numbers["least_speed"] == numbers["most_speed"]].sort_values("most_speed", kind="stable")
    lost, unconverged, starts = (stated[name].to_numpy() for name in ("lost", "unconverged", "starts"))
    with np.errstate(invalid="ignore"):
        values = lost / (starts - unconverged)
    least, _ = exact_interval(lost, starts)
    _, most = exact_interval(lost + unconverged, starts)
    shares = zip(values.tolist(), least.tolist(), most.tolist(), strict=True)
    found: dict[tuple[str, Gains, str], list[Spun]] = {}
    columns = ["contender", "kp", "kv", "engine", "most_speed", "starts", "unconverged"]
    rows = stated[columns].itertuples(index=False, name=None)
    for (law, kp, kv, engine, speed, count, apart), share in zip(rows, shares, strict=True):
        one = Spun(speed, count, apart, Estimate(*share))
        found.setdefault((law, Gains(kp, kv), engine), []).append(one)
    return found


@functools.lru_cache(maxsize=1)
def spun_in(folder: Path) -> dict[tuple[str, Gains, str], list[Spun]]:
    """Return `list_spun` of the maps in a folder, once for the runs at all gains."""
    return list_spun(count_in(folder))
