"""A function asked of pairs: its answers, and where it had none."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.audit.pairs import Pairs

NO_THREE_NUMBERS = "it returned no three numbers, but "


class Answers(NamedTuple):
    """e (n x 3), NaN where there are no three numbers; raised (n): the reason there, else an empty string.

    changed (n): whether the function wrote into what it was given.
    """

    e: np.ndarray
    raised: list[str]
    changed: np.ndarray


def inputs(takes: str, pairs: Pairs) -> tuple[np.ndarray, np.ndarray]:
    """What the function is given, pair by pair."""
    if takes == "matrix":
        return pairs.R, pairs.R_d
    order = [0, 1, 2, 3] if takes == "wxyz" else [1, 2, 3, 0]
    return pairs.q[:, order], pairs.q_d[:, order]


def ask(function: Callable, takes: str, pairs: Pairs) -> Answers:
    """Its answers to every pair, each from arrays of its own."""
    return ask_of(function, *inputs(takes, pairs))


def ask_of(function: Callable, now: np.ndarray, goal: np.ndarray) -> Answers:
    """Return the function's answers to each pair of the two arrays."""
    e, raised, changed = np.full((len(now), 3), np.nan), [], np.zeros(len(now), bool)
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        for i, (one, other) in enumerate(zip(now, goal, strict=True)):
            given = one.copy(), other.copy()
            e[i], reason = _answer(function, *given)
            raised.append(reason)
            changed[i] = not (np.array_equal(given[0], one) and np.array_equal(given[1], other))
    return Answers(e, raised, changed)


def _answer(function: Callable, now: np.ndarray, goal: np.ndarray) -> tuple[np.ndarray | float, str]:
    """Three numbers, or NaN and the reason."""
    try:
        said = function(now, goal)
    except Exception as error:  # whatever it raises is its answer
        return np.nan, f"{type(error).__name__}: {error}"
    try:
        numbers = np.asarray(said).astype(float)
    except (TypeError, ValueError):
        return np.nan, f"{NO_THREE_NUMBERS}{type(said).__name__}"
    except RuntimeError as error:  # a tensor that keeps a gradient
        return np.nan, f"{NO_THREE_NUMBERS}{type(said).__name__} ({error})"
    if numbers.size != 3:
        return np.nan, f"{NO_THREE_NUMBERS}an array of shape {numbers.shape}"
    return numbers.reshape(3), ""
