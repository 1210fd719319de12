"""The pairs of orientations at which a function is called, with the rotation theta about k from R to R_d that is true.

A pair is made from integers and from cos(theta/2), sin(theta/2): R_d = T R. Where digits or exactness matter, R is one
of the four diagonal rotations, by which products are exact, so that T itself is what the function sees; elsewhere R is
drawn, uniform. Quaternions have q . q_d >= 0.
"""

from __future__ import annotations

import functools
import itertools
from typing import Literal, NamedTuple

import numpy as np

from bench.audit.rotations import matrices, product

Place = Literal["wide", "close", "fine", "identity", "near-identity", "near-180", "at-180", "pole", "cube", "line"]
Numbers = np.ndarray | float
SEED = 7
LARGEST = 1000
"""Largest of the drawn integers: fine enough that no two axes are one."""


class Pairs(NamedTuple):
    """Some pairs: place (n), R and R_d (n x 3 x 3), q and q_d (n x 4, wxyz), axis in base (n x 3), angle (n).

    distance (n): pi - angle, with all its digits.
    """

    place: np.ndarray
    R: np.ndarray
    R_d: np.ndarray
    q: np.ndarray
    q_d: np.ndarray
    axis: np.ndarray
    angle: np.ndarray
    distance: np.ndarray

    def chosen(self, which: np.ndarray | slice) -> Pairs:
        """Return the pairs of a mask, of indices or of a slice."""
        return Pairs(*(field[which] for field in self))

    def at(self, *places: Place) -> np.ndarray:
        """Return the pairs of these places, as a mask."""
        return np.isin(self.place, places)


def made(place: Place, q: np.ndarray, axis: np.ndarray, cosine: Numbers, sine: Numbers) -> Pairs:
    """Pairs from q (n x 4), axes of any length (n x 3), and the functions of half the angle.

    T = I + 2 c s K + 2 s^2 K^2 with K = [k x]: near 180° and at it every element is right to an ulp, and T symmetric.
    """
    count = len(q)
    cosine, sine = np.broadcast_to(cosine, count), np.broadcast_to(sine, count)
    square = (axis * axis).sum(axis=1)
    k = axis / np.sqrt(square)[:, None]
    N = np.cross(axis[:, None, :], np.eye(3)).swapaxes(1, 2)
    first, second = 2.0 * cosine * sine / np.sqrt(square), 2.0 * sine * sine / square
    T = np.eye(3) + first[:, None, None] * N + second[:, None, None] * (N @ N)
    R = matrices(q)
    return Pairs(
        np.full(count, place),
        R,
        T @ R,
        q,
        product(np.hstack((cosine[:, None], sine[:, None] * k)), q),
        k,
        2.0 * np.arctan2(sine, cosine),
        2.0 * np.arctan2(cosine, sine),
    )


def joined(*parts: Pairs) -> Pairs:
    """Join them."""
    return Pairs(*map(np.concatenate, zip(*parts, strict=True)))


CUBE_AXES = np.array(sorted(itertools.product((1, 0, -1), repeat=3), key=lambda k: np.abs(k).sum())[1:], dtype=float)
"""To the faces, edges and corners of a cube, in this order."""


def diagonal(count: int) -> np.ndarray:
    """Return the quaternions 1, i, j, k in turn, 1 first."""
    return np.eye(4)[np.arange(count) % 4]


def drawn_axes(rng: np.random.Generator, count: int) -> np.ndarray:
    """Integers in every direction."""
    return rng.integers(1, LARGEST, size=(count, 3)) * rng.choice((-1.0, 1.0), size=(count, 3))


def drawn_orientations(rng: np.random.Generator, count: int) -> np.ndarray:
    """Return unit quaternions of integers, uniform: those of a cube within the ball."""
    found = rng.integers(-LARGEST, LARGEST + 1, size=(8 * count, 4)).astype(float)
    square = (found * found).sum(axis=1)
    kept = found[(square <= LARGEST**2) & (square > 1.0)][:count]
    return kept / np.sqrt((kept * kept).sum(axis=1))[:, None]


def at_angles(place: Place, rng: np.random.Generator, angles: np.ndarray) -> Pairs:
    """One pair an angle, from drawn orientations about drawn axes."""
    count = len(angles)
    return made(
        place, drawn_orientations(rng, count), drawn_axes(rng, count), np.cos(angles / 2.0), np.sin(angles / 2.0)
    )


def at_decades(place: Place, rng: np.random.Generator, is_near_180: bool) -> Pairs:
    """1, 2 and 5 times every power of ten from 10^-12 to 10^-1 rad: of the angle, or of what lacks to 180°."""
    lengths = np.array([times * 10.0**-decade for decade in range(12, 0, -1) for times in (1, 2, 5)])
    axes = np.vstack((CUBE_AXES[:12], drawn_axes(rng, 4)))
    half, axis = np.repeat(lengths / 2.0, len(axes)), np.tile(axes, (len(lengths), 1))
    whole = (np.sin(half), np.cos(half)) if is_near_180 else (np.cos(half), np.sin(half))
    return made(place, diagonal(len(half)), axis, *whole)


def at_180(rng: np.random.Generator) -> Pairs:
    """Exactly 180°: about coordinate axes, axes with zero components and drawn ones; then from drawn orientations."""
    axes = np.vstack((CUBE_AXES, (3, 4, 0), (0, -5, 12), (8, 0, 15), drawn_axes(rng, 19)))
    exact = [made("at-180", np.tile(np.eye(4)[i], (len(axes), 1)), axes, 0.0, 1.0) for i in range(4)]
    return joined(*exact, made("at-180", drawn_orientations(rng, 48), drawn_axes(rng, 48), 0.0, 1.0))


def at_poles(rng: np.random.Generator) -> Pairs:
    """R with a middle Euler angle of +-90° about each axis, and rotations by +-90° about each from drawn ones."""
    root = np.sqrt(0.5)
    axes = np.repeat(np.vstack((np.eye(3), -np.eye(3))), 12, axis=0)
    poles = np.hstack((np.full((len(axes), 1), root), root * axes))
    goals = made("pole", poles, drawn_axes(rng, len(axes)), np.cos(0.3), np.sin(0.3))
    return joined(goals, made("pole", drawn_orientations(rng, len(axes)), axes, root, root))


@functools.cache
def every_pair() -> Pairs:
    """Return all of them, the simplest of a place first."""
    rng = np.random.default_rng(SEED)
    cube = np.vstack((np.eye(4), [(0.5, x, y, z) for x in (0.5, -0.5) for y in (0.5, -0.5) for z in (0.5, -0.5)]))
    whole = np.vstack((cube, drawn_orientations(rng, 28)))
    turned = np.repeat(cube[:6], len(CUBE_AXES), axis=0), np.tile(CUBE_AXES, (6, 1))
    root = np.sqrt(0.5)
    return joined(
        at_angles("wide", rng, np.linspace(0.3, 2.8, 600)),
        at_angles("close", rng, np.linspace(0.05, 0.3, 200)),
        at_angles("fine", rng, np.linspace(0.005, 0.05, 100)),
        made("identity", whole, np.ones((len(whole), 3)), 1.0, 0.0),
        at_decades("near-identity", rng, is_near_180=False),
        at_decades("near-180", rng, is_near_180=True),
        at_180(rng),
        at_poles(rng),
        made("cube", *turned, root, root),
        made("cube", *turned, 0.5, np.sqrt(0.75)),
    )
