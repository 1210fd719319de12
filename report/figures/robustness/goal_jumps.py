"""Goals that jump while the body moves: how often a law then unwinds, and when it settles, its memory kept or reset."""

import math

import pandas as pd

from bench.findings.perturbed import DETOUR, FAR_RAD
from bench.findings.selection.regions import find_default
from bench.findings.selection.reset import KEPT, RESET, SOON_S, describe_resets
from report.figures.kit import families, html
from report.figures.kit.page import Run
from report.figures.robustness.half_turn_noise import regulator_of
from report.figures.robustness.robustness import along, counted, laws

PATHS = html.Table(
    "Law | Long, kept [%]:.1f | Long, reset [%]:.1f | Longest, kept [°]:.0f | Longest, reset [°]:.0f | "
    "Median time, kept [s]:.3f | Median time, reset [s]:.3f"
)


def soon(run: Run, axis: str) -> pd.DataFrame:
    """Return rows of `by_level` of the jumps up to SOON_S, without the negative controls."""
    rows, known = counted(run, axis), laws(along(run, axis), controls=False)
    return rows[(rows["level"] > 0.0) & (rows["level"] <= SOON_S) & rows["contender"].isin(known)]


def measure(rows: pd.DataFrame) -> tuple[float, float, float]:
    """Return the share of paths over DETOUR times the angle at the jump [%], the longest path [deg], and the time.

    The time is the greatest median settling time of a level [s].
    """
    share = 100.0 * rows["long"].sum() / rows["far"].sum()
    return share, math.degrees(rows["path_rad"].max()), rows["median_s"].max()


def compare_paths(run: Run, kept: pd.DataFrame, reset: pd.DataFrame) -> list[tuple]:
    """Return each law with memory that always settles: its measures, those of memory kept and reset side by side."""
    found = []
    for law in laws(along(run, KEPT), controls=False):
        own = [rows[rows["contender"] == law] for rows in (kept, reset)]
        if regulator_of(law).memory and all((rows["good"] == rows["starts"]).all() for rows in own):
            pairs = zip(*map(measure, own), strict=True)
            found.append((families.word(law), *(number for pair in pairs for number in pair)))
    return found


def facts(run: Run) -> dict:
    """Return how many starts jump, when, which ratio counts, and what a reset changes for each law."""
    kept, reset = soon(run, KEPT), soon(run, RESET)
    return {
        "n": int(kept["starts"].max()),
        "times": " or ".join(f"{1000.0 * level:g}" for level in sorted(kept["level"].unique())),
        "detour": f"{DETOUR:g}",
        "near": f"{FAR_RAD:g}",
        "paths": PATHS(compare_paths(run, kept, reset)),
        "resets": describe_resets(find_default()),
    }
