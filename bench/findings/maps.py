"""What a map says of laws: the share of starts that are lost, with its interval, and the slowest."""

import functools
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.base.errors import NoTable
from bench.experiments.tables.run import with_contender
from bench.experiments.tables.statistics import Estimate
from bench.experiments.tables.store import read
from bench.law.inputs import Gains

SPEEDS = ["least_speed", "most_speed"]
KEY = ["contender", "kp", "kv", "engine", *SPEEDS]
"""What one count is of."""


def read_maps(folder: Path) -> pd.DataFrame:
    """Return the rows of every map in a folder of maps, a folder each, in the order of their names."""
    paths = sorted(folder.glob("*/map.parquet"))
    frames = [read(path.parent, "map") for path in paths]
    if not frames:
        raise NoTable(f"{folder}: there is no map in it; make one with bench map --out {folder}/NAME")
    words = [name for name in frames[0] if isinstance(frames[0][name].dtype, pd.CategoricalDtype)]
    together = pd.concat([frame.astype(dict.fromkeys(words, str)) for frame in frames], ignore_index=True)
    return together.astype(dict.fromkeys(words, "category"))


def at_gains(rows: pd.DataFrame, gains: Gains) -> pd.DataFrame:
    """Return the rows that were simulated with these gains; there may be none."""
    return rows[(rows["kp"] == gains.kp) & (rows["kv"] == gains.kv)]


@functools.cache
def lost_share(lost: int, of: int) -> Estimate:
    """Return a share with its exact 95 % interval (C. Clopper, E. Pearson, Biometrika 26, 1934)."""
    from scipy.stats import binomtest

    interval = binomtest(lost, of).proportion_ci(0.95, method="exact")
    return Estimate(lost / of, float(interval.low), float(interval.high))


def counted(rows: pd.DataFrame) -> pd.DataFrame:
    """How many starts a law, gains and speed have, and how many of them are lost or do not converge.

    Columns: contender, kp, kv, engine, least_speed, most_speed [rad/s], starts, settled, unconverged, lost.
    """
    cells = with_contender(rows[rows["row"] == "cell"])
    numbers = ["starts", "settled", "unconverged"]
    found = cells.groupby(KEY, sort=False, observed=True)[numbers].sum().reset_index()
    return found.assign(lost=found["starts"] - found["settled"] - found["unconverged"])


@functools.lru_cache(maxsize=1)
def count_in(folder: Path) -> pd.DataFrame:
    """Return `counted` of the maps in a folder, once for the runs at all gains."""
    return counted(read_maps(folder))


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
    shares = 1e6 * np.array([lost_share(*pair) for pair in zip(found["lost"].tolist(), of.tolist(), strict=True)])
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
    of_law = at_gains(numbers, gains)
    of_law = of_law[(of_law["contender"] == law) & (of_law["engine"] == engine)]
    own = of_law[of_law["least_speed"] == of_law["most_speed"]]
    columns = own.sort_values("most_speed")[["most_speed", "starts", "lost", "unconverged"]]
    return [
        Spun(speed, starts, unconverged, lost_between(lost, unconverged, starts))
        for speed, starts, lost, unconverged in columns.itertuples(index=False, name=None)
    ]
