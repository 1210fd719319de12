"""Directed start sets of the free body that findings count together, and how many starts of each a finding needs."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Mapping

import tasks
from bench.base.on_first_use import pd
from bench.experiments.slices import read_slices
from bench.experiments.suites import SUITES
from bench.experiments.tables.rows import number_rows

AT_REST = ("half-turn", "poles", "wraps", "box")
"""Starts at rest whose goal is the identity: points of SO(3) alone."""

DIRECTED = (*AT_REST, "tumbling", "goals")
"""All sets but the uniform one and the paper's three examples."""


@functools.cache
def least_starts(engine: str, part: str = "slices") -> dict[str, int]:
    """Return the starts that the smallest suite has of each set that all suites run by an engine.

    part: of a suite: `slices` of the paper's laws, `beyond` of later ones and in other coordinates.
    """
    sizes = []
    for suite in SUITES.values():
        slices = read_slices(suite.sections["free-body"][part])
        names = {one.selector: one.total or None for one in slices if one.engine == engine}
        sizes.append({name: count_of_set(name, size) for name, size in names.items()})
    shared = [name for name in ("uniform", *DIRECTED) if all(name in own for own in sizes)]
    return {name: min(own[name] for own in sizes) for name in shared}


@functools.cache
def count_of_set(start_set: str, size: int | None) -> int:
    """Return how many starts a set has in a suite; size: that of the suite, None for the set's own."""
    return tasks.start_set_length(start_set, size, 0)


def describe_lacking(frame: pd.DataFrame, least: Mapping[str, int], *start_sets: str) -> str:
    """Name the start sets (these or all) with fewer starts than `least`; return an empty text if none has."""
    found = count_starts(frame)
    few = [name for name in start_sets or least if found.get(name, 0) < least.get(name, 0)]
    return ", ".join(f"{found.get(name, 0):,} of {least[name]:,} {name}" for name in few)


def count_starts(frame: pd.DataFrame) -> Counter[str]:
    """Return how many different starts of each set some episodes have, by the name of the set."""
    first, _ = number_rows(frame, ("start_set", "start_id"))
    start_sets = frame["start_set"].astype(object).to_numpy()[first]
    return Counter(start_sets.tolist())
