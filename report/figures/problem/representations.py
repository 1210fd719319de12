"""Coordinates of the page on failures: what there is, and how far rebuilt rotations are off near a pole.

Three ways take Z-Y-X angles off a matrix: ours (gamma measured in the frame turned by alpha), the textbook's (each from
its own two elements, Craig 1986), and scipy's `Rotation.as_euler`. The orientations are quaternions turned to matrices
in doubles, as MuJoCo does.
"""

from __future__ import annotations

import functools
import itertools
import math
import sys
import warnings

import numpy as np
from scipy.spatial.transform import Rotation as Scipy

from bench.law.contenders.registry import contenders
from bench.law.contenders.representations.zyx_euler import chart, to_matrix
from bench.law.so3 import Rotation, from_quaternion
from report.figures.kit.page import Run
from report.figures.kit.spelling import power, prose
from report.figures.kit.tables import Table
from tasks.rotations import multiply, on_pole, zyx

COORDINATES = Table("Coordinates | Definition | Where it breaks | Source")
DECADES = np.arange(0.0, 16.01, 0.25)
PAIRS = 64
SEED = 0


def facts(_: Run) -> dict:
    """Return how far each way to take angles off a matrix is off, and how fast angles move near a pole."""
    return {
        **{f"worst_{way}": power(worst) for way, worst in extracted().items()},
        "orientations": 2 * PAIRS,
        "gain": f"{gain(0.5):.0f}",
    }


def tables(_: Run) -> dict:
    """Every representation there is."""
    coordinates = [
        (one.title, f"${one.formula}$", prose(where_it_breaks(one)), one.source)
        for one in contenders("representations").values()
    ]
    return {"representations": COORDINATES(coordinates)}


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
def extracted() -> dict[str, float]:
    """Return the largest error [rad] of each way over PAIRS orientations at each distance to each pole."""
    pairs = np.random.default_rng(SEED).uniform(-math.pi, math.pi, size=(PAIRS, 2)).tolist()
    places = itertools.product(pairs, (1, -1), DECADES)
    rotations = [build_near_pole(alpha, gamma, sign, 10.0**-decade) for (alpha, gamma), sign, decade in places]
    return {way: max(error(R, angles(R)) for R in rotations) for way, angles in WAYS.items()}


def build_near_pole(alpha: float, gamma: float, sign: int, distance: float) -> Rotation:
    """The rotation with beta = sign (pi/2 - distance): first the pole, then back by `distance` about y, exactly."""
    pole = multiply(zyx(alpha, 0.0, 0.0), on_pole(sign, 0.0))
    back = (math.cos(distance / 2), 0.0, -sign * math.sin(distance / 2), 0.0)
    return from_quaternion(multiply(multiply(pole, back), zyx(0.0, 0.0, gamma)))
