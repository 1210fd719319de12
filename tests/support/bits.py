"""Equality bit for bit, and the unit of the last place that every tolerance here is counted in."""

import numpy as np

EPS = float(np.finfo(float).eps)
"""2^-52: the distance from 1 to the next double. One rounding of a number below 2 in size errs by EPS/2 or less."""


def same_bits(given, expected) -> bool:
    """Whether two arrays of doubles are the same numbers, zeros with their sign; one NaN is as good as another."""
    given, expected = np.array(given, dtype=float), np.array(expected, dtype=float)
    given[np.isnan(given)] = expected[np.isnan(expected)] = np.nan
    return given.shape == expected.shape and given.tobytes() == expected.tobytes()


def different_rows(given, expected) -> list[int]:
    """Indices of the rows that are not the same bits: what a failing test shows."""
    return [i for i, (g, e) in enumerate(zip(given, expected, strict=True)) if not same_bits(g, e)]
