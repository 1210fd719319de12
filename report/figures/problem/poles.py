"""Which combination of alpha and gamma is left on each pole of Z-Y-X angles (Murphy 1988, 2.2)."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.contenders.representations.zyx_euler import to_matrix
from report.figures.kit import html
from report.figures.kit.spelling import power

PAIRS, SEED = 64, 0
POLES = {"+π/2": math.pi / 2.0, "−π/2": -math.pi / 2.0}
STEP_RAD = 1.0
"""alpha and gamma move by this much: far above rounding, and no multiple of a turn."""


def distance(first: tuple, second: tuple) -> float:
    """Angle between the rotations of two triples of angles [rad]."""
    far = float(np.linalg.norm(np.array(to_matrix(first)) - np.array(to_matrix(second))))
    return 2.0 * math.asin(min(1.0, far / math.sqrt(8.0)))


def measured() -> pd.DataFrame:
    """Largest motion of R over PAIRS pairs at each pole [rad], alpha and gamma moved together or against each other."""
    pairs = np.random.default_rng(SEED).uniform(-math.pi, math.pi, size=(PAIRS, 2)).tolist()
    rows = []
    for name, beta in POLES.items():
        moves = {"together": (STEP_RAD, STEP_RAD), "against": (STEP_RAD, -STEP_RAD)}
        moved = {
            word: max(distance((a, beta, c), (a + da, beta, c + dc)) for a, c in pairs)
            for word, (da, dc) in moves.items()
        }
        rows.append({"pole": name, "pairs": PAIRS, **moved})
    return pd.DataFrame(rows)


def table(found: pd.DataFrame) -> html.Markdown:
    """The same, with what is determined there."""
    left = [
        "$\\alpha - \\gamma$" if row.together < row.against else "$\\alpha + \\gamma$" for row in found.itertuples()
    ]
    names = {"pole": "β", "together": "α and γ both + 1", "against": "α + 1, γ − 1"}
    frame = found.drop(columns="pairs").rename(columns=names).assign(**{"What R determines": left})
    return html.table(frame, {names["together"]: power, names["against"]: power}, words=["β"])


def gain(short_deg: float) -> float:
    """Largest |Edot| that a unit of |omega| can mean this far from a pole: 1 / sqrt(1 - |sin beta|)."""
    return 1.0 / math.sqrt(1.0 - math.cos(math.radians(short_deg)))
