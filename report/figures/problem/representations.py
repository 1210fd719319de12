"""Coordinates of the page on failures: what there is, and how far rebuilt rotations are off near a pole.

Three ways take Z-Y-X angles off a matrix: ours (gamma measured in the frame turned by alpha), the textbook's (each from
its own two elements, Craig 1986), and scipy's `Rotation.as_euler`. The orientations are quaternions turned to matrices
in doubles, as MuJoCo does.
"""

from __future__ import annotations

import functools
import math
import sys
import warnings

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation as Scipy

from bench.law.contenders.registry import known_representations
from bench.law.contenders.representations.zyx_euler import chart, to_matrix
from bench.law.so3 import Rotation, from_quaternion
from report.figures.kit.page import Run
from report.figures.kit.spelling import power, prose
from report.figures.kit.tables import Table
from report.figures.problem import conditioning
from tasks import start_set
from tasks.rotations import multiply, on_pole, zyx

COORDINATES = Table("Coordinates | Definition | Where it breaks | Source")
DECADES = np.arange(0.0, 16.01, 0.25)
PAIRS = 64
SEED = 0


def facts(_: Run) -> dict:
    """How far each way to take angles off a matrix is off; how fast angles move near a pole."""
    found = extracted()
    worst = found.groupby("way")["error"].max()
    return {
        **{f"worst_{way}": power(float(worst[way])) for way in WAYS},
        "orientations": 2 * PAIRS,
        "scipy_jump": power(jump(found)),
        "gain": f"{gain(0.5):.0f}",
    }


def tables(_: Run) -> dict:
    """Every representation there is."""
    coordinates = [
        (one.title, f"${one.formula}$", prose(where_it_breaks(one)), one.source)
        for one in known_representations().values()
    ]
    return {"representations": COORDINATES(coordinates)}


def figures(_: Run) -> dict:
    """Draw where each map of rates loses rank."""
    return {"conditioning": conditioning.conditioning()}


def where_it_breaks(one) -> str:
    """What the module's docstring says after its first paragraph."""
    text = sys.modules[one.chart.__module__].__doc__ or ""
    return " ".join(text.partition("\n\n")[2].split())


def gain(short_deg: float) -> float:
    """Largest |Edot| that a unit of |omega| can mean this far from a pole: 1 / sqrt(1 - |sin beta|)."""
    return 1.0 / math.sqrt(1.0 - math.cos(math.radians(short_deg)))


def ours(R: Rotation) -> tuple:
    """The representation's own."""
    return chart(R).E


def textbook(R: Rotation) -> tuple:
    """alpha, beta, gamma each from its own elements (Craig 1986)."""
    beta = math.atan2(-R.n[2], math.sqrt(R.n[0] * R.n[0] + R.n[1] * R.n[1]))
    return math.atan2(R.n[1], R.n[0]), beta, math.atan2(R.o[2], R.a[2])


def scipys(R: Rotation) -> tuple:
    """scipy's, which sets the third angle to zero near the pole and warns."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return tuple(Scipy.from_matrix(np.array(R).T).as_euler("ZYX"))


WAYS = {"textbook": textbook, "scipy": scipys, "ours": ours}


def error(R: Rotation, angles: tuple) -> float:
    """Frobenius distance of the rebuilt matrix over sqrt(2): the angle between the two, for small ones [rad]."""
    return float(np.linalg.norm(np.array(to_matrix(angles)) - np.array(R)) / math.sqrt(2.0))


@functools.cache
def extracted() -> pd.DataFrame:
    """Largest error of each way over PAIRS orientations at each distance to each pole; distance 0: the exact starts."""
    generator = np.random.default_rng(SEED)
    pairs = generator.uniform(-math.pi, math.pi, size=(PAIRS, 2)).tolist()
    rows = []
    for sign in (1, -1):
        places = [
            (10.0**-decade, [build_near_pole(alpha, gamma, sign, 10.0**-decade) for alpha, gamma in pairs])
            for decade in DECADES
        ]
        word = "plus" if sign > 0 else "minus"
        exact = [start.quat_wxyz for start in start_set("poles") if start.id.startswith(f"pole-{word}-exact")]
        places.append((0.0, [from_quaternion(quat) for quat in exact]))
        for distance, rotations in places:
            for way, angles in WAYS.items():
                worst = max(error(R, angles(R)) for R in rotations)
                rows.append({"pole": sign, "distance": distance, "way": way, "error": worst})
    return pd.DataFrame(rows)


def build_near_pole(alpha: float, gamma: float, sign: int, distance: float) -> Rotation:
    """The rotation with beta = sign (pi/2 - distance): first the pole, then back by `distance` about y, exactly."""
    pole = multiply(zyx(alpha, 0.0, 0.0), on_pole(sign, 0.0))
    back = (math.cos(distance / 2), 0.0, -sign * math.sin(distance / 2), 0.0)
    return from_quaternion(multiply(multiply(pole, back), zyx(0.0, 0.0, gamma)))


def jump(found: pd.DataFrame) -> float:
    """The largest distance at which scipy's error is a thousand times ours: where it gives one angle up [rad]."""
    worst = found[found["distance"] > 0.0].pivot_table(index="distance", columns="way", values="error", aggfunc="max")
    return float(worst.index[worst["scipy"] > 1e3 * worst["ours"]].max())
