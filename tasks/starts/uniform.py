"""Orientations spread evenly over SO(3) by the Haar measure, at rest: what fractions are counted on."""

from __future__ import annotations

from tasks.base import Start, StartSet
from tasks.haar import halton, orientation


def between(first: int, end: int, seed: int) -> list[Start]:
    """Return the points from `first` to before `end`."""
    points = enumerate(halton(end - first, 3, seed, first), first)
    return [Start(f"uniform-{i:05d}", orientation(*point)) for i, point in points]


STARTS = StartSet("uniform", "Low-discrepancy orientations, Haar measure", 5000, between=between)
