"""The cost-performance plane: what a law costs a tick against how much of SO(3) it settles, and how fast.

Cost is flops plus a price for each transcendental call, without the stage `goal` (the paper is given the goal in the
law's own coordinates); the prices and the bounds are those by which claim C17 is decided.
"""

from __future__ import annotations

from typing import NamedTuple

import pandas as pd

from bench.findings.claims.costs import CALL_PRICE, CALL_PRICES, DEAR, SETTLED_SHARE, SLOW
from report.figures.cost.operations import CALLS
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.share import Share, share

NONE_AT = 2e-5
"""Where a logarithmic axis shows a share of zero, labelled as such."""


class Place(NamedTuple):
    """Where a law stands: cost, and settling over the uniform starts."""

    name: str
    flops: int
    calls: int
    settled: Share
    median_s: float
    p99_s: float
    worst_s: float

    def cost(self, price: float = CALL_PRICE) -> float:
        """Flops with a transcendental call counted as so many."""
        return self.flops + price * self.calls


def places(costs: pd.DataFrame, uniform: pd.DataFrame) -> list[Place]:
    """Every law that has both a cost and uniform starts, the cheapest first."""
    counted = costs[(costs["branch"] == "typical") & ~costs["stage"].isin(["total", "goal"])]
    found = []
    for name, rows in uniform.groupby("contender", observed=True):
        own = counted[counted["contender"] == name]
        times = rows.loc[rows["outcome"] == "settled", "settling_time_s"]
        calls = int(own[list(CALLS)].to_numpy().sum())
        settled = share(len(times), len(rows))
        found.append(
            Place(name, int(own["flops"].sum()), calls, settled, times.median(), times.quantile(0.99), times.max())
        )
    return sorted(found, key=Place.cost)


@responsive_picture
def plane(found: list[Place], titles: dict[str, str], small_s: float, *, narrow=False):
    """Two panels over the same cost: share that does not settle, and settling time.

    Args:
        small_s: settling time of a small error, the measure of the slowest that is adequate.
    """
    figure, (left, right) = style.beside(2, 3.7, 6.6, narrow)
    bound = DEAR * min(one.cost() for one in found)
    for one in found:
        look = style.look(one.name)
        cost, low, high = one.cost(), one.cost(CALL_PRICES[0]), one.cost(CALL_PRICES[1])
        marks = {"color": look.colour, "marker": look.marker, "linestyle": "none", "markersize": 7, "zorder": 3}
        bar = {"color": look.colour, "linewidth": 1.3, "zorder": 2}
        failing = 1.0 - one.settled.value or NONE_AT
        left.plot(cost, failing, **marks)
        left.plot([cost, cost], [min(failing, 1.0 - one.settled.high or NONE_AT), 1.0 - one.settled.low], **bar)
        left.plot([low, high], [failing] * 2, **bar)
        right.plot([], [], label=titles.get(one.name, one.name), **marks)
        if one.settled.k:
            right.plot(cost, one.p99_s, **marks)
            right.plot([cost, cost], [one.median_s, one.worst_s], **bar)
            right.plot([low, high], [one.p99_s] * 2, **bar)
    limits = {"color": style.MUTED, "linewidth": 0.9, "linestyle": (0, (4, 3)), "zorder": 1}
    for axes, level in ((left, 1.0 - SETTLED_SHARE), (right, SLOW * small_s)):
        axes.axvline(bound, **limits)
        axes.axhline(level, **limits)
        axes.set_xlabel(f"Flops a tick, a call counted as {CALL_PRICE:g}")
        axes.set_xlim(left=0)
        note = {"color": style.MUTED, "fontsize": 9, "ha": "right", "va": "top"}
        axes.annotate("adequate", (bound, level), (-4, -3), textcoords="offset points", **note)
    left.set(yscale="log", ylabel="Uniform starts that do not settle", ylim=(1e-5, 1.6))
    left.set_yticks([NONE_AT, 1e-4, 1e-3, 1e-2, 1e-1, 1.0], ["none", "0.01 %", "0.1 %", "1 %", "10 %", "100 %"])
    left.minorticks_off()
    right.set(ylabel="Settling time [s]", yscale="log")
    ticks = [0.5, 1, 2, 5]
    right.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    right.set_ylim(0.5, max(5.0, 1.3 * max(one.worst_s for one in found if one.settled.k)))
    right.minorticks_off()
    handles, words = right.get_legend_handles_labels()
    figure.legend(handles, words, loc="outside upper left", ncols=1 if narrow else 3, columnspacing=1.4)
    said = "; ".join(sentence(one, titles) for one in found)
    return figure, f"Cost against performance, one mark a law. {said}."


def sentence(one: Place, titles: dict[str, str]) -> str:
    """A law's place in words."""
    pace = f", 99th percentile {one.p99_s:.2f} s, worst {one.worst_s:.2f} s" if one.settled.k else ""
    return f"{titles.get(one.name, one.name)}: cost {one.cost():.0f}, {one.settled.value:.1%} settle{pace}"
