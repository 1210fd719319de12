"""How two laws, or two controllers, stand in cost: by time where intervals part, by operations where they do not.

Times are ratios to a kernel timed in the same passes, of every machine that results/timings knows. Operations are flops
and calls of sin, cos, atan2 and acos, in columns of their own; where the columns differ, they are put together by what
a call takes in those times, never by a price of ours.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.statistics import Estimate
from bench.findings.amounts import join_words

ORDERED, UNDECIDED, REVERSED = 1, 0, -1

RULE = """
    For each pair, we ask whether the law that the paper calls cheaper is cheaper. The two laws are timed in turns on
    one machine (results/timings). The times confirm the paper's order if two conditions are met on every machine on
    which both laws were timed: the law that the paper calls cheaper takes less time, and the 95 % intervals do not
    overlap. The operations confirm this order if the law that the paper calls more expensive has at least as many flops
    and at least as many calls, and more of one of the two. The times decide. If the intervals overlap, or if one of the
    laws was not timed, the operations decide. If flops and calls give different orders, their weighted sum decides. In
    this sum, a call counts as n flops if it takes as long as n flops.
    """

MEASURABLE = 0.04
"""Share of a controller's or a loop's time by which two must differ, beyond their intervals, to count as different. An
interval is of one build; compiled apart, two builds differ by some per cent more than their laws alone do."""

FEWEST = 6
"""Timed laws from which on a call has a price: twice the numbers that are fitted."""


class Operations(NamedTuple):
    """Flops and calls of a tick."""

    flops: int
    calls: int

    def __str__(self) -> str:
        return f"{self.flops} and {self.calls}"

    def without(self, part: Operations) -> Operations:
        """Return what is left without a part of them."""
        return Operations(self.flops - part.flops, self.calls - part.calls)

    def weighed(self, price: float) -> float:
        """Flops with a call counted as so many."""
        return self.flops + price * self.calls


Times = list[dict[str, Estimate]]
"""Time a tick over that of the kernel, by contender, of each machine and arm."""


class Standing(NamedTuple):
    """Whether a pair is in the stated order: by time, by columns in each accounting, and at the price of a call.

    is_known: whether times or a price are there to decide where columns do not.
    """

    by_time: int
    by_columns: tuple[int, ...]
    priced: tuple[int, ...]
    is_known: bool = True

    @property
    def sign(self) -> int:
        """What decides: time, else operations."""
        return self.by_time or self.by_operations

    @property
    def by_operations(self) -> int:
        """What columns say in every accounting; where they differ, flops and calls at the price of a call."""
        signs = {columns or priced for columns, priced in zip(self.by_columns, self.priced, strict=True)}
        return signs.pop() if len(signs) == 1 else UNDECIDED

    @property
    def is_disputed(self) -> bool:
        """Whether columns, in some accounting, say the opposite of time."""
        return bool(self.by_time) and -self.by_time in self.by_columns


class Ledger(NamedTuple):
    """What is known of cost: times of everything timed, operations by contender in each accounting, a call's price.

    least: share by which times must differ beyond their intervals.
    """

    times: Times
    accountings: tuple[dict[str, Operations], ...]
    price: float
    least: float = 0.0

    def stand(self, cheap: str, dear: str) -> Standing:
        """How a pair stands, the cheaper by the claim first."""
        pairs = [(one[cheap], one[dear]) for one in self.accountings]
        sums = (other.weighed(self.price) - one.weighed(self.price) for one, other in pairs)
        timed = [one for one in self.times if cheap in one and dear in one]
        columns = tuple(by_columns(*pair) for pair in pairs)
        are_equal = all(one == other for one, other in pairs)
        return Standing(
            agreed(by_times(one[cheap], one[dear], self.least) for one in timed),
            columns,
            tuple(int(np.nan_to_num(np.sign(more))) for more in sums),  # undecided where the price is not known
            is_known=bool(timed) or are_equal or 0 not in columns or np.isfinite(self.price),
        )

    def over(self, name: str, other: str) -> str:
        """'10.3', the ratio of their times on each machine that has both; 'not timed'."""
        found = [one[name].value / one[other].value for one in self.times if name in one and other in one]
        return join_words(f"{ratio:.3g}" for ratio in found) or "not timed"


def agreed(signs: Iterable[int]) -> int:
    """Return what all that decide say; undecided if two of them differ, or none decides."""
    found = set(signs) - {UNDECIDED}
    return found.pop() if len(found) == 1 else UNDECIDED


def by_times(cheap: Estimate, dear: Estimate, least: float = 0.0) -> int:
    """Which side of the one the other's interval lies on; undecided if they differ by the share `least` or less."""
    if abs(dear.value - cheap.value) <= least * min(cheap.value, dear.value):
        return UNDECIDED
    return ORDERED if cheap.high < dear.low else REVERSED if dear.high < cheap.low else UNDECIDED


def by_columns(cheap: Operations, dear: Operations) -> int:
    """Compare by columns: in order if none falls and one rises, reversed if none rises, undecided otherwise."""
    return agreed(np.sign(np.subtract(dear, cheap)).astype(int).tolist())


def times_of(rows: pd.DataFrame) -> Times:
    """Ratios from rows of results/timings with `machine` and `contender`, by machine and arm."""
    found: dict[tuple, dict[str, Estimate]] = {}
    columns = ["machine", "arm", "contender", "ratio", "ratio_low", "ratio_high"]
    for machine, arm, name, *ratio in zip(*(rows[column].tolist() for column in columns), strict=True):
        found.setdefault((machine, arm), {})[name] = Estimate(*ratio)
    return list(found.values())


def price_of_a_call(times: Times, operations: dict[str, Operations]) -> float:
    """Fit the flops that a call takes, the median over machines: time on 1, flops and calls, none negative.

    It is not a number where fewer than FEWEST counted laws were timed, or a flop takes no time in the fit.
    """
    prices = []
    for one in times:
        known = [name for name in one if name in operations]
        if len(known) < FEWEST:
            continue
        amounts = np.array([(1.0, *operations[name]) for name in known])
        _, flop, call = fit_nonnegative(amounts, np.array([one[name].value for name in known]))
        if flop > 0.0:
            prices.append(call / flop)
    return float(np.median(prices)) if prices else float("nan")


def fit_nonnegative(A: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return x >= 0 with the least |A x - b|: shapes (m, n), (m,) and (n,), n small, columns of A independent.

    At the minimum, the elements of x that are not zero solve the problem without a bound. So of all choices of these
    elements, that one is taken which leaves the least and has none below zero (C. Lawson, R. Hanson, Solving Least
    Squares Problems, 1974, chapter 23).
    """
    count = A.shape[1]
    best, least = np.zeros(count), float(np.linalg.norm(b))
    for flags in itertools.product((False, True), repeat=count):
        chosen = np.array(flags)
        if not chosen.any():
            continue
        x = np.zeros(count)
        x[chosen] = np.linalg.lstsq(A[:, chosen], b, rcond=None)[0]
        left = float(np.linalg.norm(A @ x - b))
        if x.min() >= 0.0 and left < least:
            best, least = x, left
    return best
