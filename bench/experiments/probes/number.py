"""One number that a probe measured, and what it is a number of: a row of probes.parquet."""

from __future__ import annotations

from typing import NamedTuple

from bench.law.inputs import Gains

NO_LAW = {
    "regulator": "",
    "representation": "",
    "jacobian": "",
    "inverse": "",
}
"""Words of a row about no law."""


class Number(NamedTuple):
    """One number that a probe measured.

    Attributes:
        measure: What was measured, with its unit at the end.
        value: The number.
        case: Which start, state, pose or element of a matrix.
        at: Where it was measured: an angle, a distance, a level; each probe says which.
        outcome: How the episode ended; empty where none was run.
        words: Words of the law, or of coordinates alone (`Contender.words`).
        gains: Gains of its own; None for those of the run.
    """

    measure: str
    value: float
    case: str = ""
    at: float = 0.0
    outcome: str = ""
    words: dict[str, str] = NO_LAW
    gains: Gains | None = None


def in_coordinates(name: str) -> dict[str, str]:
    """Return the words of a row about coordinates without a law."""
    return {**NO_LAW, "representation": name}
