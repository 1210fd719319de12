"""What a law takes of a whole controller's tick, by the times of results/timings.

Two laws must differ by `standing.MEASURABLE` of it to be distinguished by time. That was 0.03 when the rule was fixed,
by three runs of the same loops; the advice is the same by both (a test).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims.tables import Results
from bench.tables.read import with_contender

if TYPE_CHECKING:
    import pandas as pd


def ticks(results: Results) -> dict[str, float]:
    """Law -> its time alone over the shortest tick of any arm's closed loop [%], the median over machines.

    Laws that no machine timed are left out. The loop is MuJoCo's step with controller and judge, so that the share of a
    controller which computes the arm's dynamics itself is of the same order.
    """
    found: dict[str, list[float]] = {}
    for frame in _machines(results):
        is_loop = (frame["what"] == "engine") & (frame["engine"] == "native") & (frame["arm"] != "")
        tick_ns = frame.loc[is_loop & (frame["ticks"] > 0), "ns_per_tick"].min()
        alone = frame[(frame["what"] == "law") & (frame["ticks"] > 0)]
        for law, ns in zip(alone["contender"].astype(str), alone["ns_per_tick"], strict=True):
            found.setdefault(law, []).append(100.0 * float(ns / tick_ns))
    return {law: float(np.median(shares)) for law, shares in found.items() if np.isfinite(shares).all()}


def _machines(results: Results) -> list[pd.DataFrame]:
    """Times of each machine; those of files that say nothing of arms are of no use."""
    from bench.tables.store import read_arrow

    if "timings" in results.frames:
        return [with_contender(results.frames["timings"])]
    every = (read_arrow(path, "timings").to_pandas() for path in sorted(results.timings_folder.glob("*.parquet")))
    return [with_contender(frame) for frame in every if "arm" in frame]
