"""Settling time against the bound of the command, a wrong inertia and the time of a jump: the default and two others.

The rows are those of the map of advice, one number of the nominal situation changed at a time.
"""

import math

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from bench.experiments.tables.run import Run
from bench.findings.selection.regions import find_default, list_ours, read_map
from bench.findings.selection.unbeaten import find_runner_up
from bench.findings.selection.words import together
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import in_run
from tasks.situation import NOMINAL, read_situation

PANELS = {
    "bound": "bound of the command [kp rad]",
    "inertia": "true inertia / inertia of the model",
    "jump": "time of the jump [1/√kp]",
}
"""Number of a situation -> the label of its axis."""

TICKS = {
    "bound": (0.05, 0.1, 0.2, 0.5, 1.0, 3.0),
    "inertia": (0.4, 0.7, 1.0, 2.0, 4.0),
    "jump": (0.0, 1.0, 2.0, 5.0),
}
UNBOUNDED = 5.0
"""Place of "no bound" on the axis of bounds, whose last bound is 3 kp rad."""

TIMES = (5.0, 7.0, 10.0, 20.0, 30.0)


def list_shown() -> list[str]:
    """Return the default, the law of the second widest region, and ours that the pages speak of."""
    candidates = [find_default(), find_runner_up(), *(law for law in list_ours() if law == "late-braking")]
    return [law for law in candidates if law]


def follow(number: str) -> pd.DataFrame:
    """Return the times of 99 % of the starts: a row a value of one number, a column a law; never is infinite."""
    rows = read_map()
    situations = [read_situation(str(word)) for word in rows["situation"]]
    others_nominal = [at._replace(**{number: getattr(NOMINAL, number)}) == NOMINAL for at in situations]
    line = rows[others_nominal]
    line = line.assign(time=line["time"].where(line["lost"] == 0, math.inf))
    return line.pivot(index=number, columns="contender", values="time")[list_shown()]


@responsive_picture
def draw_situations(times: dict[str, pd.DataFrame], narrow: bool) -> Drawing:
    """Draw a panel a number, a line a law; times: of `follow`."""
    shape = (len(times), 1) if narrow else (1, len(times))
    height = 2.3 * len(times) + 0.4 if narrow else 3.3
    figure, grid = style.panels(*shape, height=height, narrow=narrow, sharey=True, squeeze=False)
    words = []
    for axes, (number, line) in zip(grid.flat, times.items(), strict=True):
        draw_panel(axes, number, line)
        words.append(f"{PANELS[number]}: {describe_line(line)}")
    for axes in grid[:, 0]:
        axes.set_ylabel("99 % settled after [1/√kp]")
    handles = [axes.lines[index] for index in range(len(list_shown()))]
    names = [families.word(law) for law in list_shown()]
    figure.legend(handles, names, loc="outside upper left", ncols=2 if narrow else 3, fontsize=10)
    return figure, f"Time in which 99 % of the starts settle. {'. '.join(words)}."


def draw_panel(axes: Axes, number: str, line: pd.DataFrame) -> None:
    """Draw one number's panel, with the nominal value marked."""
    values = [UNBOUNDED if math.isinf(value) else value for value in line.index]
    for law in line:
        look = style.look(str(law))
        axes.plot(values, line[law], color=look.colour, marker=look.marker, markersize=3.5, linewidth=1.4)
    axes.set(yscale="log", xlabel=PANELS[number])
    if number != "jump":
        axes.set_xscale("log")
    ticks = [tick for tick in TICKS[number] if min(values) <= tick <= max(values)]
    labels = [f"{tick:g}" for tick in ticks]
    if UNBOUNDED in values and number == "bound":
        ticks, labels = [*ticks, UNBOUNDED], [*labels, "∞"]
    axes.set_xticks(ticks, labels)
    axes.set_yticks(TIMES, [f"{time:g}" for time in TIMES])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_minor_locator(NullLocator())


def describe_line(line: pd.DataFrame) -> str:
    """Return each law's times from the least value to the greatest."""
    parts = []
    for law in line:
        times = ", ".join(f"{time:.1f}" for time in line[law])
        parts.append(f"{families.word(str(law))} {times}")
    values = ", ".join("none" if math.isinf(value) else f"{value:g}" for value in line.index)
    return f"at {values}: {'; '.join(parts)}"


def describe_widest(line: pd.DataFrame) -> str:
    """Say at which bound another law is faster than the default by the most, where the default settles."""
    default, other = list_shown()[:2]
    settled = line[np.isfinite(line[default])]
    place = (settled[default] / settled[other]).idxmax()
    times = {law: f"{line.loc[place, law]:.1f}/√kp" for law in (default, other)}
    return (
        f"At a bound of {place:g} kp, 99 % of the starts settle within {times[other]} with "
        f"{families.word(other)} and within {times[default]} with the default law, "
        f"{families.word(default)}"
    )


def name_law(law: str) -> str:
    """Return a law's name, and that it is ours if it is."""
    return f"{families.word(law)}{' (ours)' if law in list_ours() else ''}"


def facts(_: Run) -> dict:
    """Return the picture, what it shows, its laws, and the name of the default."""
    return in_run(describe_situations) or {}


def describe_situations() -> dict:
    """Return the picture and its words; NoTable without the map."""
    times = {number: follow(number) for number in PANELS}
    return {
        "times": draw_situations(times),
        "finding": describe_widest(times["bound"]),
        "default": families.word(find_default()),
        "laws": together([name_law(law) for law in list_shown()]),
    }
