"""the function reads the elements of a quaternion in the wrong order.

effect: the command hardly depends on the real error; the robot turns about a wrong axis, and may never stop
cure: convert the order between libraries that use different orders; name the order, wxyz or xyzw, in each variable
law: quaternion-shortest
"""

import itertools
from collections.abc import Iterator

import numpy as np

from bench.audit.examined import Examined, Model, Symptom, explanation, inputs
from bench.audit.pairs import Pairs
from bench.audit.rotations import product

ORDERS = ("wxyz", "xyzw")
READ = {"wxyz": [0, 1, 2, 3], "xyzw": [3, 0, 1, 2], "xyzw, shifted the wrong way": [1, 2, 3, 0]}
"""Places that w, x, y, z are taken from."""


def find(examined: Examined) -> Symptom | None:
    """Find the other order than stated, or one order here and the other there."""
    stated, found = examined.stated.takes, examined.convention
    if found and stated in ORDERS and found.takes in ORDERS and found.takes != stated:
        return Symptom(f"stated to take {stated}, it takes {found.takes}")
    if examined.takes not in ORDERS:
        return None
    text = f"{{}}, of quaternions given as {examined.takes}"
    return explanation(examined, lambda pairs: models(examined.takes, pairs), text)


def models(takes: str, pairs: Pairs) -> Iterator[Model]:
    """Each step of vec(q_d q*) in either order, of vec(q* q_d), and of both with swapped arguments."""
    now, goal = inputs(takes, pairs)
    for first, second, conjugate, vector in itertools.product(READ, READ, ORDERS, ORDERS):
        p, p_d = now[:, READ[first]], goal[:, READ[second]]
        negated = np.where(np.arange(4) > 0, -1.0, 1.0) if conjugate == "wxyz" else np.array((-1.0, -1.0, -1.0, 1.0))
        part = slice(1, 4) if vector == "wxyz" else slice(0, 3)
        words = (
            f"q read as {first}, q_d as {second}, conjugated as {conjugate} and the vector part taken as of {vector}"
        )
        for one, other in ((p_d, negated * p), (p, negated * p_d)):
            for whole in (product(one, other), product(other, one)):
                yield words, whole[:, part]
