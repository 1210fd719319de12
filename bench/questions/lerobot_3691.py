"""A policy's rotation vectors jump to their antipodal twins, and the gripper tumbles between them."""

import functools
import itertools

import numpy as np

from bench.questions.question import Curves, Question
from tasks.goal_stream import PERIOD_S, STREAMS, goals
from tasks.truth import angle

DT = 1e-3


@functools.cache
def rates(name: str) -> np.ndarray:
    """Rate of the filled-in goal at each tick [rad/s]."""
    (stream,) = [one for one in STREAMS if one.name == name]
    filled = goals(stream, DT).tolist()
    return np.array([angle(a, b) for a, b in itertools.pairwise(filled)]) / DT


def curves() -> Curves:
    """Componentwise against by the logarithm."""
    before = rates("rotation-vector")
    return Curves(DT * np.arange(len(before)), before, rates("log"))


QUESTION = Question(
    "lerobot-3691",
    "The gripper tumbles between two goals of a policy",
    tuple(f"huggingface/lerobot#{number}" for number in (3691, 3710, 4002)),
    "Between two neighbouring actions that are nearly one orientation the gripper sweeps through the identity; "
    "inverse kinematics turn that into jumps of joints, the servos cut them off, and the arm stalls and lurches.",
    "A rotation vector near 180° has a twin some 2π away, of the other sign. Componentwise interpolation between the "
    "two passes through zero.",
    f"R₀ exp(s log(R₀ᵀ R₁)), or the twin nearer to the last vector. Here goals come every {PERIOD_S * 1e3:g} ms.",
    "time [s]",
    "rate of the interpolated goal [rad/s]",
    curves,
    right=1.0,
    tolerance=1.0,
)
