"""Answers of functions that mix something up, in closed form, beside those of one whose convention is not known."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from bench.audit.convention import ENOUGH, apart
from bench.audit.examined import Examined
from bench.audit.pairs import WIDE, Pairs

Model = tuple[str, np.ndarray]
"""Words, and vectors (n x 3)."""

EXPLAINED_RAD = 1e-3
"""Largest angle to a model's line; of two random directions one in two million is so near."""


def explanation(examined: Examined, models: Callable[[Pairs], Iterable[Model]]) -> tuple[str, int] | None:
    """The model along whose vectors most answers lie, in words, and a pair that shows it; None if there is none.

    Args:
        examined: a function whose convention is not known.
        models: pairs -> (words, vectors n x 3) of each.
    """
    if examined.convention:
        return None
    here = np.flatnonzero(examined.at(WIDE))
    best, share = None, ENOUGH
    for words, vectors in models(examined.pairs.chosen(here)):
        angle = apart(examined.e[here], vectors)
        is_along = (angle < EXPLAINED_RAD) | (angle > np.pi - EXPLAINED_RAD)
        if is_along.mean() > share:
            best, share = (words, int(here[np.argmax(is_along)])), float(is_along.mean())
    return best


def axis_of(X: np.ndarray) -> np.ndarray:
    """2 sin(theta) k of rotations X (n x 3 x 3)."""
    return np.stack((X[:, 2, 1] - X[:, 1, 2], X[:, 0, 2] - X[:, 2, 0], X[:, 1, 0] - X[:, 0, 1]), axis=1)


def rotated(X: np.ndarray, v: np.ndarray) -> np.ndarray:
    """X v (n x 3)."""
    return np.einsum("nij,nj->ni", X, v)
