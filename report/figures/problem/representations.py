"""What the page on coordinates shows: what there is, and what of Z-Y-X angles is left on and near a pole."""

from __future__ import annotations

import functools
import math
import sys

import numpy as np
import pandas as pd

from bench.contenders.registry import known_representations
from bench.contenders.representations.zyx_euler import to_matrix
from report.figures.kit.page import Run
from report.figures.kit.spelling import power, prose
from report.figures.kit.tables import Table
from report.figures.problem import conditioning, extraction

PAIRS, SEED = 64, 0
POLES = {"+π/2": math.pi / 2.0, "−π/2": -math.pi / 2.0}
STEP_RAD = 1.0
"""alpha and gamma move by this much: far above rounding, and no multiple of a turn."""

COORDINATES = Table("Coordinates | Definition | Where it breaks | Source")
ON_POLES = Table(
    "β | α and γ both + 1 | α + 1, γ − 1 | What R determines",
    {"α and γ both + 1": power, "α + 1, γ − 1": power},
    words=["β"],
)
extracted = functools.cache(extraction.errors)


def facts(_: Run) -> dict:
    """How far each way to take angles off a matrix is off; how fast angles move near a pole."""
    found = extracted()
    worst = found.groupby("way")["error"].max()
    return {
        **{f"worst_{way}": power(float(worst[way])) for way in extraction.WAYS},
        "orientations": 2 * extraction.PAIRS,
        "scipy_jump": power(extraction.jump(found)),
        "gain": f"{gain(0.5):.0f}",
        "pairs": PAIRS,
    }


def tables(_: Run) -> dict:
    """Every representation there is; what the matrix determines on each pole (Murphy 1988, 2.2)."""
    coordinates = [
        (one.title, f"${one.formula}$", prose(where_it_breaks(one)), one.source)
        for one in known_representations().values()
    ]
    on_poles = [
        (row.pole, row.together, row.against, f"$\\alpha {'-' if row.together < row.against else '+'} \\gamma$")
        for row in poles().itertuples()
    ]
    return {"representations": COORDINATES(coordinates), "poles": ON_POLES(on_poles)}


def figures(_: Run) -> dict:
    """Where each map of rates is lost."""
    return {"conditioning": conditioning.conditioning()}


def where_it_breaks(one) -> str:
    """What the module's docstring says after its first paragraph."""
    text = sys.modules[one.chart.__module__].__doc__ or ""
    return " ".join(text.partition("\n\n")[2].split())


def distance(first: tuple, second: tuple) -> float:
    """Angle between the rotations of two triples of angles [rad]."""
    far = float(np.linalg.norm(np.array(to_matrix(first)) - np.array(to_matrix(second))))
    return 2.0 * math.asin(min(1.0, far / math.sqrt(8.0)))


def poles() -> pd.DataFrame:
    """Largest motion of R over PAIRS pairs at each pole [rad], alpha and gamma moved together or against each other."""
    pairs = np.random.default_rng(SEED).uniform(-math.pi, math.pi, size=(PAIRS, 2)).tolist()
    rows = []
    for name, beta in POLES.items():
        moves = {"together": (STEP_RAD, STEP_RAD), "against": (STEP_RAD, -STEP_RAD)}
        moved = {
            word: max(distance((a, beta, c), (a + da, beta, c + dc)) for a, c in pairs)
            for word, (da, dc) in moves.items()
        }
        rows.append({"pole": name, **moved})
    return pd.DataFrame(rows)


def gain(short_deg: float) -> float:
    """Largest |Edot| that a unit of |omega| can mean this far from a pole: 1 / sqrt(1 - |sin beta|)."""
    return 1.0 / math.sqrt(1.0 - math.cos(math.radians(short_deg)))
