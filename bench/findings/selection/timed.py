"""What a law takes of a whole controller's time, by the times of results/timings.

A whole controller (`bench.running.timing.controller`) computes the forward kinematics, D and fg, then the law, the
Jacobian, its inverse and (2.2); plant, judge and metrics are not in it. Every share of a controller has this one
denominator: the controller with the rotation-matrix law. Laws tie where shares differ by at most `standing.MEASURABLE`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bench.experiments.tables.read import with_contender
from bench.findings.claims.tables import Results

if TYPE_CHECKING:
    import pandas as pd


BY = "rotation-matrix@geometric"
"""The controller of the denominator, by the inverse of each arm."""


def ticks(results: Results) -> dict[str, float]:
    """Return law -> its time alone over a whole controller's [%], the medians over arms and over machines.

    Laws that no machine timed are left out, and so are machines that timed no whole controller.
    """
    found: dict[str, list[float]] = {}
    for frame in _machines(results):
        is_whole = (frame["what"] == "controller") & frame["contender"].astype(str).str.startswith(BY)
        whole = frame.loc[is_whole & (frame["ticks"] > 0), "ratio"].median()
        alone = frame[(frame["what"] == "law") & (frame["ticks"] > 0)]
        for law, ratio in zip(alone["contender"].astype(str), alone["ratio"], strict=True):
            found.setdefault(law, []).append(100.0 * float(ratio / whole))
    return {law: float(np.median(shares)) for law, shares in found.items() if np.isfinite(shares).all()}


def _machines(results: Results) -> list[pd.DataFrame]:
    """Times of each machine; those of files that say nothing of arms are of no use."""
    from bench.experiments.tables.store import read_arrow

    if "timings" in results.frames:
        return [with_contender(results.frames["timings"])]
    every = (read_arrow(path, "timings").to_pandas() for path in sorted(results.timings_folder.glob("*.parquet")))
    return [with_contender(frame) for frame in every if "arm" in frame]
