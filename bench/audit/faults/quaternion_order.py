"""Scalar first or last, mixed up."""

import itertools

import numpy as np

from bench.audit.asked import inputs
from bench.audit.fault import Fault, Found
from bench.audit.models import explanation
from bench.audit.pairs import Pairs, product

ORDERS = ("wxyz", "xyzw")


def find(examined) -> Found | None:
    """It takes the other order than stated, or one order here and the other there."""
    stated, found = examined.stated.takes, examined.convention
    if found and stated in ORDERS and found.takes in ORDERS and found.takes != stated:
        return Found(f"stated to take {stated}, it takes {found.takes}")
    if examined.takes not in ORDERS:
        return None
    why = explanation(examined, lambda pairs: models(examined.takes, pairs))
    return (
        Found(f"{why[0]}, of quaternions given as {examined.takes}", examined.evidence(why[1], False)) if why else None
    )


def models(takes: str, pairs: Pairs):
    """Each step of vec(q_d q*) in either order, and of vec(q* q_d)."""
    now, goal = inputs(takes, pairs)
    for first, second, conjugate, vector in itertools.product(ORDERS, repeat=4):
        p, p_d = read(now, first), read(goal, second)
        negated = np.where(np.arange(4) > 0, -1.0, 1.0) if conjugate == "wxyz" else np.array((-1.0, -1.0, -1.0, 1.0))
        part = slice(1, 4) if vector == "wxyz" else slice(0, 3)
        words = (
            f"q read as {first}, q_d as {second}, conjugated as {conjugate} and the vector part taken as of {vector}"
        )
        for whole in (product(p_d, negated * p), product(negated * p, p_d)):
            yield words, whole[:, part]


def read(given: np.ndarray, order: str) -> np.ndarray:
    """As (w, x, y, z) of what is taken for this order."""
    return given if order == "wxyz" else given[:, [3, 0, 1, 2]]


FAULT = Fault(
    "quaternion-order",
    "wrong order of the quaternion",
    "the command has little to do with the error: the robot turns about another axis, and need not stop",
    "convert where quaternions of two libraries meet, and put wxyz or xyzw into names",
    "quaternion-shortest",
    find,
)
