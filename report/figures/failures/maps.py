"""Random starts of the maps that came with the benchmark: at rest, and at stated speeds, a law a line."""

import functools
from typing import Any

import pandas as pd

from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.maps import counted, lost_share, spun
from bench.findings.theory.closed_form import pole_crossings
from report.figures.kit import families, html
from report.figures.kit.rows import LINEARIZED, SHORT
from report.figures.kit.tables import Table

MAPS = RESULTS / "maps"


@functools.cache
def rows() -> pd.DataFrame:
    """Read the rows of the maps."""
    return read.table(MAPS, "map")


@functools.cache
def numbers() -> pd.DataFrame:
    """Count starts by law and speed."""
    return counted(rows())


def speeds() -> list[float]:
    """Return the speeds of the starts [rad/s]."""
    return sorted(set(numbers()["most_speed"]))


def whole() -> list[str]:
    """Return the laws that lose none of these starts, family by family."""
    lost = numbers().groupby("contender")[["lost", "unconverged"]].sum().sum(axis=1)
    return families.in_order(lost.index[lost == 0])


def facts() -> dict:
    """Return how many starts there are, and what becomes of the paper's two laws on angles at the greatest speed."""
    fastest = max(speeds())
    linear = spun(numbers(), SHORT["f"])[-1]
    few = spun(numbers(), LINEARIZED)[-1]
    return {
        "mapped": html.number(int(numbers()["starts"].min())),
        "fastest": f"{fastest:g}",
        "none_lost": ", ".join(map(families.word, whole())) or "none",
        "apart_f": percent(linear.unconverged, linear.starts),
        "crossing_f": f"{100.0 * pole_crossings(fastest):.2f}",
        "lost_f": percent(linear.lost, linear.starts - linear.unconverged),
        "lost_l": percent(few.lost, few.starts - few.unconverged),
    }


def lost_at_rest(law: str) -> str:
    """Return the share of random starts at rest that a law loses, with its exact 95 % interval."""
    own = numbers()[(numbers()["contender"] == law) & (numbers()["most_speed"] == 0.0)]
    return percent(int(own["lost"].sum()), int(own["starts"].sum()))


def percent(some: int, of: int) -> str:
    """Return a share with its exact 95 % interval."""
    value, low, high = (100.0 * one for one in lost_share(some, of))
    return f"{value:.2f} % ({low:.2f} to {high:.2f})"


def table() -> html.Markdown | None:
    """Return the share lost by law and speed, with its interval, and the share that does not converge."""
    made = Table("Law | " + " | ".join(f"{speed:g} rad/s" if speed else "At rest" for speed in speeds()))
    found = {law: spun(numbers(), law) for law in set(numbers()["contender"]) - set(whole())}
    order = sorted(found, key=lambda law: (sum(one.lost + one.unconverged for one in found[law]), law))
    return made((html.law(law, families.word(law)), *map(cell, found[law])) for law in order)


def cell(one: Any) -> str:
    """Return the share lost of those that converge, with the interval's ends, and below it the share that does not."""
    sure = one.starts - one.unconverged
    share, interval = percent(one.lost, sure).split(" (")
    apart = f"<br>not converged {percent(one.unconverged, one.starts)}" if one.unconverged else ""
    return html.together(share) + f"<br>({interval}{apart}"
