"""The rule by which a law is advised, written and committed before any run was judged by it.

1. Asked are the laws that have a situation's facts and were measured by its criteria.
2. One law is better than another by a criterion if it is so by more than the criterion's `notable` share (a hundredth),
   and the 95 % interval of the difference over the starts, which both were given, leaves out zero (paired bootstrap,
   Efron 1979). Time a tick is compared on a whole controller: better by `tick` is what is better by more than
   MEASURABLE of its tick. All else is a tie. A law that was not timed ties by `tick` with all.
3. A law dominates another if it is better by some criterion and worse by none. A front is what no law dominates
   (Pareto 1906).
4. The best are the front by the situation's own criteria; kept of these is the front by GENERAL.
5. If several are kept they tie, and the simplest of them is advised: of least memory, then of fewest operations, each
   addition, product, quotient, root or call counted once, for they are counted here as what has to be written down and
   trusted, not as time.
6. The default asks what a law must have where nothing else is known. A situation in which the default's law is among
   the best decides nothing: no law is better there, and the default is advised.
"""

from __future__ import annotations

from collections.abc import Sequence

from bench.findings.selection.measured import Measured

GENERAL = ("time", "worst", "effort", "peak", "variation", "tick")
"""What counts in every situation: how long it takes, what it asks of motors, and of the computer."""


def front(found: Measured, laws: Sequence[str], criteria: Sequence[str]) -> list[str]:
    """The laws that no other of them dominates, in the order given.

    Ties are not transitive, so that in a circle of laws each could dominate the next; then all are kept.
    """
    kept = [law for law in laws if not any(dominates(found, other, law, criteria) for other in laws if other != law)]
    return kept or list(laws)


def dominates(found: Measured, law: str, other: str, criteria: Sequence[str]) -> bool:
    """Whether a law is better than another by some criterion, and worse by none."""
    return any(found.beats(one, law, other) for one in criteria) and not any(
        found.beats(one, other, law) for one in criteria
    )


def simplest(found: Measured, laws: Sequence[str]) -> str:
    """Return the simplest of some laws; of two alike in that, the first by name."""
    return min(laws, key=lambda law: (*found.tables.simplicity(law), law))
