"""Laws at equal stiffness and at equal peak command, each at its best damping ratio: a slope chart, and a table."""

import math
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from bench.experiments.tables.run import Run
from bench.findings.selection import sensitivity
from bench.findings.selection.regions import facts_of, find_default
from report.figures.kit import families, html, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import in_run

TUNED = html.PageTable(
    "Law | Time in which 99 % of the starts settle, at critical damping [1/√kp]:.2f | "
    "Best damping ratio at equal stiffness:.2f | "
    "Time in which 99 % of the starts settle, at the best damping ratio and equal stiffness [1/√kp]:.2f | "
    "Best damping ratio at equal peak command:.2f | "
    "Time in which 99 % of the starts settle, at the best damping ratio and equal peak command [1/√peak]:.2f"
)
LABEL_GAP = 0.034
"""Least distance of two labels, in decades of the axis."""
TICKS = (1.0, 1.2, 1.5, 2.0, 2.5)


class TunedGroup(NamedTuple):
    """Laws that have the same numbers, as the table rounds them; times in 1/√kp, the last one in 1/√peak."""

    laws: tuple[str, ...]
    at_one: float
    zeta: float
    time: float
    peak_zeta: float
    peak_time: float


def list_tuned() -> list[TunedGroup]:
    """Return the laws of the map that settle from every start, the fastest first."""
    groups: dict[tuple[float, ...], list[str]] = {}
    for each in sensitivity.tune():
        numbers = each.at_one, each.zeta, each.time, each.peak_zeta, each.peak_time
        groups.setdefault(tuple(round(float(number), 2) for number in numbers), []).append(each.law)
    return [
        TunedGroup(tuple(sorted(laws, key=_argued)), *numbers) for numbers, laws in groups.items()
    ]


def _argued(law: str) -> tuple[bool, bool, str]:
    """Sort the default to the front, and then the laws that have a colour."""
    return law != find_default(), style.look(law).colour == style.REST, law


def write_table() -> html.Markdown | None:
    """Return all numbers of the slope chart, and the times at critical damping."""
    return TUNED((", ".join(map(link, tuned.laws)), *tuned[1:]) for tuned in list_tuned())


def link(law: str) -> str:
    """Return a law with a link to its page, and whether it is ours."""
    ours = " (ours)" if facts_of(law).is_ours else ""
    return f"{families.link(law, families.word(law))}{ours}"


@responsive_picture
def draw_slopes(rows: list[TunedGroup], narrow: bool) -> Drawing:
    """Draw a line from a law's time at equal stiffness to its time at equal peak command, over the fastest law's."""
    figure, axes = style.panels(height=4.6 if narrow else 4.1, narrow=narrow)
    left, right = (min(getattr(tuned, field) for tuned in rows) for field in ("time", "peak_time"))
    ends = {}
    for tuned in rows:
        colour = style.look(tuned.laws[0]).colour
        ratios = tuned.time / left, tuned.peak_time / right
        is_argued = colour != style.REST
        axes.plot([0, 1], ratios, "-o", color=colour, linewidth=1.8 if is_argued else 1.1, markersize=4)
        ends[tuned] = ratios[1]
    label_ends(axes, ends)
    axes.set(yscale="log", xlim=(-0.08, 1.04), ylim=(0.95, 1.05 * max(ends.values())))
    axes.set_xticks([0, 1], ["equal stiffness\n[1/√kp]", "equal peak command\n[1/√peak]"])
    axes.set_yticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_ylabel("time of 99 % / that of the fastest law")
    words = "; ".join(
        f"{', '.join(map(families.word, tuned.laws))} {tuned.time:.2f} and {tuned.peak_time:.2f}" for tuned in rows
    )
    return figure, f"Time of 99 % of the starts at equal stiffness and at equal peak command: {words}."


def label_ends(axes: Axes, ends: dict[TunedGroup, float]) -> None:
    """Name each line at its right end, with its time there; a name that had to move has a line to its end."""
    places = style.apart([math.log10(ratio) for ratio in ends.values()], LABEL_GAP)
    for (tuned, ratio), place in zip(ends.items(), places, strict=True):
        colour = style.look(tuned.laws[0]).colour
        more = f" +{len(tuned.laws) - 1}" if len(tuned.laws) > 1 else ""
        axes.plot([1.02, 1.09], [ratio, 10.0**place], color=colour, linewidth=0.9, clip_on=False)
        text = f"{families.word(tuned.laws[0])}{more}, {tuned.peak_time:.2f}"
        style.label_line(axes, 1.1, 10.0**place, text, colour, fontsize=10)


def describe_slopes(rows: list[TunedGroup]) -> str:
    """Say how the default stands at equal stiffness and at equal peak command, and which law is the fastest there."""
    left, right = (min(rows, key=lambda tuned: getattr(tuned, field)) for field in ("time", "peak_time"))
    [default] = [tuned for tuned in rows if find_default() in tuned.laws]
    name, fastest = families.word(find_default()), describe_name(right.laws[0])
    return (
        f"At equal stiffness, 99 % of the starts settle within {default.time:.2f}/√kp with {name} and within "
        f"{left.time:.2f}/√kp with the fastest law. At equal peak command, 99 % of the starts settle within "
        f"{default.peak_time:.2f}/√peak with {name} and within {right.peak_time:.2f}/√peak with the fastest law, "
        f"{fastest}"
    )


def describe_name(law: str) -> str:
    """Return a law's name, and that it is ours if it is."""
    return f"{families.word(law)}{' (ours)' if facts_of(law).is_ours else ''}"


def facts(_: Run) -> dict:
    """Return the slope chart, and what it shows."""
    return in_run(show_slopes) or {}


def show_slopes() -> dict:
    """Return the slope chart, what it shows, and how many laws it has; NoTable without the map."""
    rows = list_tuned()
    return {
        "slopes": draw_slopes(rows),
        "finding": describe_slopes(rows),
        "laws": sum(len(tuned.laws) for tuned in rows),
    }
