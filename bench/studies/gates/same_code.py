"""Fifty comparisons of a checkout with itself beside busy neighbours, at the gate's own settings."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from bench.provenance import ROOT
from bench.regression.revisions import instructions, self_measure
from bench.regression.revisions.comparison import Timed
from bench.regression.revisions.measured import Wanted, second_run, timed_once
from bench.regression.revisions.process import Laws, running
from bench.studies.gates.load import neighbours

COMPARISONS = 50
COUNTED = 25
"""Of how many comparisons one has its instructions counted too, on both sides."""


AT_ONCE = 6
"""Comparisons that run at a time: each is a neighbour to the others."""


def run(count: int = COMPARISONS) -> Iterator[dict[str, Any]]:
    """One row a comparison, in their order; nothing is taken for granted because its machine code is the same.

    load: busy processes beside it, by kind. timed: every verdict of the first run. doubted: what the second run made of
    those that were not "same". instructions: how far apart counts were, if they were taken.
    """
    with ThreadPoolExecutor(AT_ONCE) as pool:
        yield from pool.map(_comparison, range(count))


def _comparison(number: int) -> dict[str, Any]:
    with neighbours(seed=number) as load, running([(ROOT, Laws()), (ROOT, Laws())]) as sides:
        wanted = Wanted(seed=number)
        _, first = timed_once(sides, self_measure.timed(sides[0]), wanted)
        again = second_run(sides, first, wanted)
        counted = number % COUNTED == 0 and not instructions.missing()
        return {
            "load": load,
            "timed": {name: _numbers(one) for name, one in first.items()},
            "doubted": {name: _numbers(one) for name, one in again.items()},
            "instructions": _apart(sides) if counted else None,
        }


def _numbers(one: Timed) -> dict[str, Any]:
    return {"ratio": round(one.ratio, 5), "p": float(f"{one.p:.3g}"), "verdict": one.verdict}


def _apart(sides) -> dict[str, float]:
    """How far apart counts of the same code are, by law, as a share."""
    names = self_measure.timed_laws(sides[0])
    one, other = (instructions.count(side, names) for side in sides)
    return {name: other[name] / one[name] - 1.0 for name in names}
