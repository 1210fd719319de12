"""Orientations on which laws and representations are tried: everywhere, and where each of them breaks.

The judge's start sets give the directed ones; the 24 rotations that permute the axes are exact in doubles and
hold the singular orientations of every sequence of Euler angles.
"""

import functools
import itertools

import numpy as np
from scipy.spatial.transform import Rotation as ScipyRotation

import tasks
from bench.law.so3 import Rotation
from tasks.rotations import about, columns

SAMPLED = 40
NEAR_IDENTITY_DECADES = range(1, 13)


def as_rotation(three_columns) -> Rotation:
    """Columns as a Rotation of numpy.float64, which is what the engines call laws with."""
    return Rotation(*(tuple(np.float64(x) for x in column) for column in three_columns))


def of_scipy(turn) -> Rotation:
    """A scipy rotation as ours."""
    return as_rotation(turn.as_matrix().T)


def rotation(quats_wxyz) -> ScipyRotation:
    """Return scipy's rotation of a quaternion, or of a stack of them."""
    return ScipyRotation.from_quat(quats_wxyz, scalar_first=True)


def directions(count: int, seed: int) -> np.ndarray:
    """Return unit vectors, drawn."""
    drawn = np.random.default_rng(seed).normal(size=(count, 3))
    return drawn / np.linalg.norm(drawn, axis=1, keepdims=True)


def vector(numbers) -> tuple:
    """Numbers, mostly three, as numpy.float64."""
    return tuple(np.float64(x) for x in numbers)


def matrix(R: Rotation) -> np.ndarray:
    """The 3 x 3 array whose columns are n, o, a."""
    return np.array(R, dtype=float).T


@functools.cache
def axis_permuting() -> tuple[Rotation, ...]:
    """The 24 rotations that take axes to axes: every element is 0, 1 or -1."""
    found = []
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            candidate = np.zeros((3, 3))
            candidate[order, range(3)] = signs
            if np.linalg.det(candidate) > 0.0:
                found.append(as_rotation(candidate.T))
    return tuple(found)


@functools.cache
def near_identity() -> tuple[Rotation, ...]:
    """The identity, and turns of 10^-1 to 10^-12 rad about axes drawn with a fixed seed."""
    axes = np.random.default_rng(1).normal(size=(len(NEAR_IDENTITY_DECADES), 3))
    turns = [about(tuple(axis), 10.0**-k) for k, axis in zip(NEAR_IDENTITY_DECADES, axes, strict=True)]
    return tuple(as_rotation(columns(q)) for q in [(1.0, 0.0, 0.0, 0.0), *turns])


@functools.cache
def rotations() -> tuple[Rotation, ...]:
    """Uniform, near identity, at and near half turns, poles and wraps, and the axis-permuting ones."""
    directed = [start for word in ("half-turn", "poles", "wraps") for start in tasks.start_set(word)]
    starts = tasks.start_set("uniform", SAMPLED, seed=2) + directed
    return (*axis_permuting(), *near_identity(), *(as_rotation(columns(s.quat_wxyz)) for s in starts))
