"""A law made slower step by step: which share of comparisons finds it by time, and whether its instructions show it.

Each step puts two dependent operations more in the way of the command, so that it waits for them. How much slower that
is, is measured: the median ratio of all comparisons of a step.
"""

import itertools
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from bench.provenance import ROOT
from bench.regression.revisions import instructions
from bench.regression.revisions.comparison import SLOWER
from bench.regression.revisions.measured import Wanted, timed_once
from bench.regression.revisions.process import Laws, running
from bench.regression.revisions.rule import confirmed
from bench.studies.gates.load import neighbours
from bench.studies.gates.planting import Edit, copy_with, replaced, unchanged

LAW = "rotation-vector"
FILE = "bench/contenders/regulators/rotation_vector.py"
PLACE = "    square = dot(v, v)\n"
STEPS = (None, 0, 1, 2, 3, 5, 8)
"""None: nothing is planted."""

REPEATS = 16
"""Comparisons of a step: each share is known to a sixteenth."""


def slower(steps: int) -> Edit:
    """The law with so many steps of x <- x/2 + w before its square; the command keeps every bit, for 0 x = 0."""
    loop = (
        f"    slow = square\n    for _ in range({steps}):\n        slow = 0.5 * slow + w\n"
        if steps
        else "    slow = square\n"
    )
    return replaced(FILE, PLACE, f"{PLACE}{loop}    square = square + 0.0 * slow\n")


def run(repeats: int = REPEATS) -> Iterator[dict[str, Any]]:
    """One row a step: in how many comparisons one run found it, and in how many a second one agreed.

    All steps run at the same time: each is a neighbour to the others.
    """
    with ThreadPoolExecutor(len(STEPS)) as pool:
        yield from pool.map(_step, range(len(STEPS)), itertools.repeat(repeats))


def _step(place: int, repeats: int) -> dict[str, Any]:
    steps = STEPS[place]
    asked = Laws(engines=False, names=(LAW,))
    with copy_with(unchanged if steps is None else slower(steps)) as copy:
        both = [(ROOT, asked), (copy, asked)]
        with running(both) as first, running(both) as second:
            found = []
            for number in range(repeats):
                seed = 1000 * (place + 1) + number
                with neighbours(seed):
                    one = timed_once(first, [LAW], Wanted(seed=seed))[1][LAW]
                    other = timed_once(second, [LAW], Wanted(seed=seed + 500))[1][LAW]
                found.append((one, other))
            counts = _instructions(first)
    return {
        "steps": steps,
        "slower": round(float(np.median([said.ratio for pair in found for said in pair])) - 1.0, 5),
        "repeats": repeats,
        "once": sum(one.verdict == SLOWER for one, _ in found),
        "twice": sum(confirmed(one, other).verdict == SLOWER for one, other in found),
        "instructions": counts,
    }


def _instructions(sides) -> list[float] | None:
    """Of base and head; None where they cannot be counted."""
    return None if instructions.missing() else [instructions.count(side, [LAW])[LAW] for side in sides]
