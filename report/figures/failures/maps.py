"""Random starts of the maps that came with the benchmark: at rest, and at stated speeds, a law a line."""

import functools

import pandas as pd

from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.maps import by_law, counted, spun
from bench.findings.theory.closed_form import pole_crossings
from bench.findings.theory.thresholds import beyond_limit
from bench.law.contender import PAPERS_GAINS
from report.figures.kit import families, html
from report.figures.kit.rows import LINEARIZED, SHORT
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from tasks.rules import RULES

MAPS = RESULTS / "maps"
MAPPED = Table("Law | Lost [ppm]:.1f | 95 % interval | Slowest [s]:.2f | From [°]")


@functools.cache
def rows() -> pd.DataFrame:
    """Read the rows of the maps."""
    return read.table(MAPS, "map")


@functools.cache
def numbers() -> pd.DataFrame:
    """Starts counted by law and speed."""
    return counted(rows())


def speeds() -> list[float]:
    """Stated speeds above zero [rad/s]."""
    return sorted(set(numbers()["most_speed"]) - {0.0})


def facts() -> dict:
    """How many starts there are, and what becomes of the paper's two laws on angles at the greatest speed."""
    fastest = max(speeds())
    linear = spun(numbers(), SHORT["f"])[-1]
    few = spun(numbers(), LINEARIZED)[-1]
    return {
        "mapped": html.number(int(numbers()["starts"].min())),
        "fastest": f"{fastest:g}",
        "apart_f": percent(linear.unconverged, linear.starts),
        "crossing_f": f"{100.0 * pole_crossings(fastest):.2f}",
        "lost_f": percent(linear.lost, linear.starts - linear.unconverged),
        "lost_l": percent(few.lost, few.starts - few.unconverged),
        "beyond_limit": f"{1e6 * beyond_limit(PAPERS_GAINS.kp, RULES.command_limit):.0f}",
        "limit": power(RULES.command_limit),
    }


def lost_at_rest(law: str) -> str:
    """The share of random starts at rest that a law loses, with its exact 95 % interval."""
    own = numbers()[(numbers()["contender"] == law) & (numbers()["most_speed"] == 0.0)]
    return percent(int(own["lost"].sum()), int(own["starts"].sum()))


def percent(some: int, of: int) -> str:
    """A share with its exact 95 % interval."""
    from bench.findings.maps import lost_share

    value, low, high = (100.0 * one for one in lost_share(some, of))
    return f"{value:.2f} % ({low:.2f} to {high:.2f})"


def at_rest() -> html.Markdown | None:
    """Starts at rest: the share lost in ppm with its interval, and the slowest."""
    lines = by_law(rows()[rows()["most_speed"] == 0.0]).sort_values(["lost", "slowest [s]"]).to_dict("records")
    return MAPPED(
        (
            html.law(line["law"], families.word(line["law"])),
            line["lost [ppm]"],
            html.together(f"{line['least [ppm]']:.1f} to {line['most [ppm]']:.1f}"),
            line["slowest [s]"],
            line["from [deg]"],
        )
        for line in lines
    )


def spinning() -> html.Markdown | None:
    """Spinning starts: by law and speed the share lost, with its interval, and the share that does not converge."""
    table = Table("Law | " + " | ".join(f"{speed:g} rad/s" for speed in speeds()))
    found = {law: [one for one in spun(numbers(), law) if one.speed > 0.0] for law in set(numbers()["contender"])}
    order = sorted(found, key=lambda law: (sum(one.lost + one.unconverged for one in found[law]), law))
    return table((html.law(law, families.word(law)), *map(cell, found[law])) for law in order)


def cell(one) -> str:
    """The share lost of those that converge, with the interval's ends, and below it the share that does not."""
    sure = one.starts - one.unconverged
    share, interval = percent(one.lost, sure).split(" (")
    apart = f"<br>not converged {percent(one.unconverged, one.starts)}" if one.unconverged else ""
    return html.together(share) + f"<br>({interval}{apart}"
