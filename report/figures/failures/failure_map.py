"""What the page on failures shows: shares of SO(3), maps, the exact points at which a law fails, how far they are."""

import functools
import math
import sys
from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from bench.experiments.tables import read
from bench.findings.theory import held_goals
from bench.law.contenders.registry import contenders
from bench.law.inputs import PAPERS_GAINS
from report.figures.failures import ball, maps, world_map
from report.figures.kit.page import Run, in_run
from report.figures.kit.rows import LINEARIZED, SHORT, lost, of
from report.figures.kit.spelling import prose
from report.figures.kit.tables import Table

EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad) and what rounding leaves of an exact one (4e-16 rad)."""

COORDINATES = Table("Coordinates | Definition | Where it breaks | Source")

NEAR_RAD = 0.1 + EXACT_RAD
"""Distance to a pole: the first decade of the set poles, 0.1 rad with its rounding."""


@functools.cache
def continuous(run: Run) -> pd.DataFrame:
    """Return the episodes on the continuous plant whose end no shorter step moves."""
    return read.converged(run.rows("episodes", task="free-body", engine="ideal-rk4"))


def facts(run: Run) -> dict:
    """Return how much each law loses, and where the linearized law's failures begin."""
    return {
        **maps.facts(),
        "held_level": f"{math.degrees(math.acos(held_goals.least_cosine(0.0, PAPERS_GAINS))):.1f}",
        "held_share": f"{100.0 * held_goals.held_share(PAPERS_GAINS):.1f}",
        # |Edot| over |omega| half a degree off a pole
        "gain": f"{1.0 / math.sqrt(1.0 - math.cos(math.radians(0.5))):.0f}",
        "mapped_l": maps.lost_at_rest(LINEARIZED),
        **(in_run(lambda: on_the_map(continuous(run))) or {}),
    }


def on_the_map(episodes: pd.DataFrame) -> dict:
    """Return what the uniform starts of the run say."""
    linearized = of(episodes, LINEARIZED)
    failed = lost(linearized)
    outside = linearized[linearized["alpha0"].abs() > np.pi / 2.0]
    return {
        "n": len(linearized),
        "failed_l": len(failed),
        "failed_others": counted(len(lost(of(episodes, SHORT[letter]))) for letter in "mf"),
        "least": f"{np.floor(np.degrees(failed['alpha0'].abs().min())):.0f}",
        "least_gamma": f"{np.degrees(failed['gamma0'].abs().min()):.0f}",
        "inside": int((failed["alpha0"].abs() < np.pi / 2.0).sum()),
        "outside": f"{100 * (1 - len(lost(outside)) / len(outside)):.0f}",
    }


def tables(_: Run) -> dict:
    """Return the maps of random starts, and coordinates."""
    coordinates = (
        (one.title, f"${one.formula}$", prose(where_it_breaks(one)), one.source)
        for one in contenders("representations").values()
    )
    return {"tab_mapped": maps.table(), "representations": COORDINATES(coordinates)}


def where_it_breaks(one: Any) -> str:
    """Return what the docstring of a representation's module says after its first paragraph."""
    text = sys.modules[one.chart.__module__].__doc__ or ""
    return " ".join(text.partition("\n\n")[2].split())


def figures(run: Run) -> dict:
    """Return the map of the world, and the ball."""
    return {"failure-map": world_map.world(continuous(run)), "ball": ball.ball(continuous(run))}


def counted(losses: Iterable[int]) -> str:
    """How many each law loses; none where no law loses any."""
    each = list(losses)
    return " and ".join(map(str, each)) if any(each) else "none"


def places(rows: pd.DataFrame) -> pd.Series:
    """On which special point of SO(3) each start lies exactly, or that it is near a pole, in words."""
    half = math.pi - rows["angle0_rad"] < EXACT_RAD
    pole = math.pi / 2.0 - rows["beta0"].abs() < EXACT_RAD
    wrap = (math.pi - rows["alpha0"].abs() < EXACT_RAD) | (math.pi - rows["gamma0"].abs() < EXACT_RAD)
    beside = math.pi / 2.0 - rows["beta0"].abs() <= NEAR_RAD
    words = np.select(
        [half & pole, half, pole, wrap, beside],
        ["180° rotation and pole", "180° rotation", "pole", "jump of atan2", "near a pole"],
        "elsewhere",
    )
    return pd.Series(words, rows.index)


def once(rows: pd.DataFrame) -> pd.DataFrame:
    """Each orientation once a law, though several sets have it."""
    return rows[~orientation(rows).assign(contender=rows["contender"]).duplicated()]


def orientation(rows: pd.DataFrame) -> pd.DataFrame:
    """R, which both quaternions of an orientation share, to the last digit but three."""
    turns = Rotation.from_quat(rows[["quat_w", "quat_x", "quat_y", "quat_z"]].to_numpy(), scalar_first=True)
    return pd.DataFrame(turns.as_matrix().reshape(-1, 9).round(13), rows.index)
