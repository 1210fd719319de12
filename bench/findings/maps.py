"""What a map says of laws: the share of starts that are lost, with its interval, and the slowest."""

import math

import pandas as pd

from bench.tables.read import with_contender
from bench.tables.statistics import Estimate


def lost_share(lost: int, of: int) -> Estimate:
    """A share with its exact 95 % interval (C. Clopper, E. Pearson, Biometrika 26, 1934)."""
    from scipy.stats import binomtest

    interval = binomtest(lost, of).proportion_ci(0.95, method="exact")
    return Estimate(lost / of, float(interval.low), float(interval.high))


def by_law(rows: pd.DataFrame) -> pd.DataFrame:
    """A line a law and largest initial speed: how many are lost, in ppm with interval, and the slowest."""
    lines = []
    for (law, speed), own in with_contender(rows).groupby(["contender", "most_speed"], sort=False, observed=True):
        cells, slowest = own[own["row"] == "cell"], own[own["row"] == "slowest"]
        starts, settled = int(cells["starts"].sum()), int(cells["settled"].sum())
        share, last = lost_share(starts - settled, starts), slowest.sort_values("settling_time_s").tail(1)
        lines.append(
            {
                "law": law,
                "speed to [rad/s]": speed,
                "starts": starts,
                "lost": starts - settled,
                **{
                    f"{head} [ppm]": 1e6 * number for head, number in zip(("lost", "least", "most"), share, strict=True)
                },
                "slowest [s]": float(last["settling_time_s"].iloc[0]) if len(last) else math.nan,
                "from [deg]": int(last["ring_deg"].iloc[0]) if len(last) else -1,
            }
        )
    return pd.DataFrame(lines)
