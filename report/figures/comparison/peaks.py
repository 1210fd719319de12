"""The time of 99 % of the starts against the greatest command: one dot a law, at the gains of the run."""

import math
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.amounts import join_words
from bench.findings.selection.regions import find_default
from bench.findings.selection.unbeaten import find_runner_up
from report.figures.comparison.comparison import costs, uniform
from report.figures.kit import families, html, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import MATRIX, TITLES, gains

NAMED = (*TITLES, "quaternion-shortest", "hybrid", "mrp", "mrp-memory", "late-braking")
"""The laws of the argument, whose dots have names."""

MOST = 30.0
"""Greatest command over kp [rad] on the axis; beyond it a law divides by nearly nothing, and stands in the rail."""

RAIL = 45.0
"""Place of the rail on the axis of commands."""

TIMES_S = (0.5, 0.6, 0.8, 1.0, 1.5, 2.0)
NEVER_S, TOP_S = 2.9, 3.3
"""Place of laws with which fewer than 99 % of the starts settle, and the top of the axis."""

COMMANDS = (1, 2, 3, 4, 6, 10, 20)
LOW_S, LEFT = 0.62, 1.3
"""Labels of faster laws stand below their dots; left of this command, a label begins at its dot."""
RATIO = 1.3
"""Dots closer to each other than this, in time and in command, share one label."""


class LawPeak(NamedTuple):
    """A law's time of 99 % of the starts [s], infinite for never, and its greatest command over kp [rad]."""

    law: str
    time_s: float
    peak: float


def list_laws(run: Run) -> list[LawPeak]:
    """Return each law that is not wrong on purpose, the fastest first."""
    rows = uniform(run)
    kp, _ = gains(rows)
    times = costs(rows, "settling_time_s")
    peaks = rows.groupby("contender", observed=True)["peak_u"].max() / kp
    found = []
    for law in times:
        if law not in families.CONTROLS:
            late = quantile_estimate(times[law].to_numpy(), 0.99).value
            found.append(LawPeak(str(law), float(late), float(peaks[law])))
    return sorted(found, key=lambda each: each.time_s)


@responsive_picture
def draw_laws(found: list[LawPeak], narrow: bool) -> Drawing:
    """Draw one dot a law; those of NAMED have names, the others are grey."""
    figure, axes = style.panels(height=4.6 if narrow else 3.6, narrow=narrow)
    axes.axhspan(2.5, TOP_S, facecolor=style.GRID, alpha=0.45, zorder=0)
    for each in sorted(found, key=lambda each: each.law in NAMED):
        colour = style.look(each.law).colour
        size = 8 if each.law in NAMED else 5.5
        alpha = 1.0 if each.law in NAMED else 0.55
        axes.plot(*place(each), "o", color=colour, markersize=size, alpha=alpha, markeredgewidth=0)
    label_laws(axes, found)
    axes.set(xscale="log", yscale="log", xlim=(0.75, 60.0), ylim=(0.43, TOP_S))
    axes.set_xticks([*COMMANDS, RAIL], [*map(str, COMMANDS), "no limit"])
    axes.set_yticks([*TIMES_S, NEVER_S], [*(f"{time:g}" for time in TIMES_S), "never"])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set(xlabel="greatest command [kp rad]", ylabel="99 % of the starts settled after [s]")
    words = "; ".join(f"{families.word(each.law)} {describe(each)}" for each in found)
    return figure, f"Time in which 99 % of the starts settle, and greatest command over kp, of each law: {words}."


def place(each: LawPeak) -> tuple[float, float]:
    """Return where a law's dot stands."""
    return (each.peak if each.peak <= MOST else RAIL), (each.time_s if math.isfinite(each.time_s) else NEVER_S)


def describe(each: LawPeak) -> str:
    """Return a law's two numbers in words."""
    time = f"{each.time_s:.2f} s" if math.isfinite(each.time_s) else "never"
    return f"{time} and {each.peak:.2g}" if each.peak <= MOST else f"{time} and no limit"


def label_laws(axes: Axes, found: list[LawPeak]) -> None:
    """Name the laws of NAMED beside their dots; laws at one place share a label."""
    groups: list[list[LawPeak]] = []
    for each in (each for each in found if each.law in NAMED):
        near = [group for group in groups if is_near(group[0], each)]
        if near:
            near[0].append(each)
        else:
            groups.append([each])
    for group in groups:
        for line, each in enumerate(group):
            shift, side = place_label(group, line)
            colour = style.look(each.law).colour
            look: dict[str, Any] = {"color": colour, "fontsize": 10, "ha": side, "va": "center"}
            axes.annotate(families.word(each.law), place(each), shift, textcoords="offset points", **look)


def place_label(group: list[LawPeak], line: int) -> tuple[tuple[float, float], str]:
    """Return the offset [pt] of a label of a group from its dot, and its alignment: below, above or beside."""
    x, y = place(group[0])
    if x >= RAIL:
        return (-7.0, -13.0 * line), "right"
    if y < LOW_S:
        return (-4.0, -13.0 * (line + 1)), "left" if x < LEFT else "center"
    if len(group) > 1:
        return (0.0, 13.0 * (line + 1)), "center"
    return (7.0, 0.0), "left"


def is_near(one: LawPeak, other: LawPeak) -> bool:
    """Tell whether two dots are so close that their labels would overlap."""
    distances = [abs(math.log(a / b)) for a, b in zip(place(one), place(other), strict=True)]
    return distances[0] < math.log(RATIO) and distances[1] < math.log(RATIO) / 3.0


def describe_argument(found: list[LawPeak]) -> str:
    """Say how fast the default, the runner-up of the map and the paper's first law are, and what they command."""
    numbers = {each.law: each for each in found}
    parts = []
    for law in (find_default(), find_runner_up(), MATRIX):
        if law in numbers and math.isfinite(numbers[law].time_s):
            each = numbers[law]
            parts.append(
                f"within {each.time_s:.2f} s with {families.word(law)} (commands up to {each.peak:.1f} kp)"
            )
    return f"99 % of the starts settle {join_words(parts)}"


def facts(run: Run) -> dict:
    """Return the picture, what it shows, and how many laws and starts it has."""
    found = list_laws(run)
    return {
        "picture": draw_laws(found),
        "finding": describe_argument(found),
        "laws": len(found),
        "starts": html.number(uniform(run)["start_id"].nunique()),
    }
