"""Goals that jump while the body moves: how often a law then unwinds, with its memory kept or reset."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.findings.claims.adequacy import DETOUR
from report.figures.kit import families
from report.figures.kit.page import Run
from report.figures.kit.tables import Table
from report.figures.robustness.half_turn_noise import regulator_of
from report.figures.robustness.rows import along, laws, of, starts

KEPT, RESET = "goal-jump", "goal-jump-reset"
SOON_S = 0.2
"""Latest jump that finds the body far from its first goal [s]: two time constants 1/10 s."""

NEAR_RAD = 0.5
"""A new goal nearer than this at the jump is left out: the body's stop alone is a long path beside it."""

PATHS = Table("Law | Long, kept [%]:.1f | Long, reset [%]:.1f | Longest, kept [°]:.0f | Longest, reset [°]:.0f")


def soon(run: Run, axis: str) -> pd.DataFrame:
    """Return rows of the jumps up to SOON_S whose goal is farther than NEAR_RAD then, without the negative controls."""
    rows = along(run, axis)
    is_meant = rows["contender"].isin(laws(rows, controls=False)) & (rows["judged_rad"] > NEAR_RAD)
    return rows[is_meant & (rows["level"] > 0.0) & (rows["level"] <= SOON_S)]


def measure(rows: pd.DataFrame) -> tuple[float, float]:
    """Return the share of paths over DETOUR times the angle at the jump [%], and the longest path [deg]."""
    path = rows["path_ratio"]
    return 100.0 * float((path > DETOUR).mean()), float(np.degrees((path * rows["judged_rad"]).max()))


def compare_paths(run: Run) -> list[tuple]:
    """Return each law that always settles: its measures, those of memory kept and reset side by side."""
    kept, reset = soon(run, KEPT), soon(run, RESET)
    found = []
    for law in laws(kept):
        own = of(kept, law), of(reset, law)
        if all(rows["good"].all() for rows in own):
            found.append(
                (families.word(law), *(number for pair in zip(*map(measure, own), strict=True) for number in pair))
            )
    return found


def tables(run: Run) -> dict:
    """Return the paths of each law that always settles."""
    return {"paths": PATHS(compare_paths(run))}


def facts(run: Run) -> dict:
    """Return how many starts jump, when, which ratio counts, and the longest path of a law with memory [deg]."""
    kept, reset = soon(run, KEPT), soon(run, RESET)
    remembers = [law for law in laws(kept) if regulator_of(law).memory]
    longest = [measure(rows[rows["contender"].isin(remembers)])[1] for rows in (kept, reset)]
    return {
        "n": starts(along(run, KEPT)),
        "times": " or ".join(f"{1000.0 * level:g}" for level in sorted(kept["level"].unique())),
        "detour": f"{DETOUR:g}",
        "near": f"{NEAR_RAD:g}",
        **dict(zip(("kept", "reset"), (f"{angle:.0f}" for angle in longest), strict=True)),
    }
