"""What the page on failures shows: which starts each of the paper's laws loses, in numbers and against the angle."""

import functools
import math
import textwrap
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, NullLocator

from bench.experiments.tables.run import Run, converged
from bench.experiments.tables.schema import RESULTS
from bench.findings.amounts import count
from bench.findings.claims.tables import settled
from bench.findings.conclusions import read_texts
from bench.findings.maps import at_gains, counted, lost_share, read_maps
from bench.findings.selection.regions import find_default
from bench.law.inputs import PAPERS_GAINS
from report.figures.kit import families, html, laws, style
from report.figures.kit.inline import Drawing, Picture, responsive_picture
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.page import in_run

SETS = ("uniform", "half-turn", "poles", "wraps", "box")
"""Start sets at rest whose goal is zero."""

DRAWN = 1000
"""Uniform dots a panel: the first of a low-discrepancy sequence, which cover SO(3) evenly at any number."""

SINCE = "Since 1988: with memory"
CONCLUSIONS = {
    MATRIX: "rotation-matrix",
    LINEARIZED: "linearized-euler",
    FEEDBACK: "feedback-linearized",
    SINCE: "open-question",
}
"""Panel -> the paper's conclusion whose words stand over it."""
QUOTE_WIDTH = {False: 28, True: 55}
"""Letters in a line over a panel, on a page and on a phone."""
MOST_LINES = {28: 3, 55: 2}
"""Lines of the longest quotation at that width."""
QUOTE_LINE_PT = 12.5

TIMES = (0.5, 1, 2, 5)
LOWEST, RAIL, NEVER = 0.45, 11.0, 17.0  # [s] of the log scale: its foot, and where the rail above it begins and lies
CEILING = NEVER**2 / RAIL
ASIDE = 0.16  # decades: dots of the rail are spread over its height, or hundreds would lie on one line


def facts(run: Run) -> dict:
    """Return how much each law loses, the paper's three laws from every angle, and where the failures begin."""
    maps = read_maps(RESULTS / "maps")  # those that came with the benchmark
    mapped = counted(at_gains(maps, PAPERS_GAINS))
    own = mapped[(mapped["contender"] == LINEARIZED) & (mapped["most_speed"] == 0.0)]  # at rest
    value, low, high = (100.0 * one for one in lost_share(int(own["lost"].sum()), int(own["starts"].sum())))
    return {
        "mapped": html.number(int(mapped["starts"].min())),
        "mapped_l": f"{value:.2f} % (95 % interval: {low:.2f} to {high:.2f} %)",
        # |Edot| over |omega| half a degree off a pole
        "gain": f"{1.0 / math.sqrt(1.0 - math.cos(math.radians(0.5))):.0f}",
        "hero": in_run(hero_picture, run),
        "finding": in_run(lambda: say_finding(run.rows("episodes", engine="ideal-rk4"))),
        **(in_run(lambda: on_the_map(run)) or {}),
    }


def on_the_map(run: Run) -> dict:
    """Return what the uniform starts of the run say, on the continuous plant, whose end no shorter step moves."""
    rows = converged(run.rows("episodes", task="free-body", engine="ideal-rk4", start_set="uniform"))
    linearized, *others = (rows[rows["contender"] == name] for name in (LINEARIZED, MATRIX, FEEDBACK))
    failed, *lost = (own[~settled(own)] for own in (linearized, *others))
    return {
        "n": len(linearized),
        "failed_l": len(failed),
        "others": say_others(len(lost[0]), len(lost[1]), len(linearized)),
        "least": f"{np.floor(np.degrees(failed['alpha0'].abs().min())):.0f}",
        "least_gamma": f"{np.degrees(failed['gamma0'].abs().min()):.0f}",
    }


def say_others(matrix: int, feedback: int, starts: int) -> str:
    """Say from how many of the random starts the two other laws never settle."""
    if not matrix and not feedback:
        return "The rotation-matrix law and the feedback-linearized law settle from every random start."
    counts = " and ".join(
        f"the {name} law fails from {lost or 'none'}"
        for name, lost in (("rotation-matrix", matrix), ("feedback-linearized", feedback))
    )
    return f"Of the {starts} random starts, {counts}."


class Panel(NamedTuple):
    """A law of the headline figure: its contender, its title, and what the paper says of it or wants in its place."""

    contender: str
    title: str
    quote: str
    section: str


def list_panels() -> list[Panel]:
    """Return the paper's three laws in its order, and the law that is advised today."""
    contenders = [*laws.TITLES, find_default()]
    panels = []
    for contender, (title, conclusion) in zip(contenders, CONCLUSIONS.items(), strict=True):
        texts = read_texts()[conclusion]
        quote = texts["short"].replace("...", "…")
        panels.append(Panel(contender, laws.TITLES.get(contender, title), quote, texts["section"]))
    return panels


def find_common_starts(episodes: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return contender -> its rows, at rest and with goal zero, from the starts that all laws of the figure have."""
    rows = episodes[episodes["start_set"].isin(SETS)]
    names = [panel.contender for panel in list_panels()]
    of_law = {name: rows[rows["contender"] == name].set_index(["start_set", "start_id"]) for name in names}
    present = {name: own for name, own in of_law.items() if len(own)}
    common = functools.reduce(pd.MultiIndex.intersection, (own.index for own in present.values()))
    return {name: own.loc[common].reset_index() for name, own in present.items()}


def count_lost(rows: pd.DataFrame) -> dict[str, tuple[int, int]]:
    """Return how many starts never settle, and of how many: the uniform ones, and those chosen to be difficult."""
    is_uniform, is_lost = rows["start_set"] == "uniform", rows["outcome"] != "settled"
    kinds = {"random": is_uniform, "difficult": ~is_uniform}
    return {kind: (int((chosen & is_lost).sum()), int(chosen.sum())) for kind, chosen in kinds.items()}


def hero_picture(run: Run) -> Picture:
    """Return the headline figure of a run, on the continuous plant."""
    return hero(run.rows("episodes", engine="ideal-rk4"))


def say_finding(episodes: pd.DataFrame) -> str:
    """Return how many of the common starts each law of the figure never settles from."""
    lost = {}
    for name, rows in find_common_starts(episodes).items():
        lost[name] = int((rows["outcome"] != "settled").sum())
        starts = len(rows)
    papers = [f"{families.word(name)}: {count(lost[name], 'start')}" for name in laws.TITLES if name in lost]
    default = find_default()
    advised = f"The law {families.word(default)} is not in this run."
    if default in lost:
        settles_from_all = f"settles from all {html.number(starts)} starts"
        settles = f"never settles from {count(lost[default], 'start')}" if lost[default] else settles_from_all
        advised = f"With {families.word(default)}, the body {settles}."
    return (
        f"We simulated each law from the same {html.number(starts)} starts. With Murphy's laws, the body never settles "
        f"from some of these starts ({', '.join(papers)}). {advised}"
    )


def draw_hero(episodes: pd.DataFrame, narrow: bool, height: float = 3.6) -> Drawing:
    """Draw one engine's settling time by initial angle, a panel a law; what never settles is in the band on top.

    episodes: from which the starts are taken that all laws share, from rest with goal zero.
    """
    of_law = find_common_starts(episodes)
    drawn = [panel for panel in list_panels() if panel.contender in of_law]
    columns = 1 if narrow else len(drawn)
    rows = len(drawn) // columns
    inches = 2.4 * rows if narrow else height
    figure, grid = style.panels(rows, columns, height=inches, narrow=narrow, sharex=True, sharey=True, squeeze=False)
    told = []
    for axes, panel in zip(grid.flat, drawn, strict=True):
        told.append(_draw_panel(axes, panel, of_law[panel.contender], QUOTE_WIDTH[narrow]))
    for axes in grid[:, 0]:
        axes.set_ylabel("settling time [s]")
    if narrow:
        grid[-1, 0].set_xlabel("initial angle to the goal [deg]")
    else:
        figure.supxlabel("initial angle to the goal [deg]", fontsize=10.5)
    return figure, "Settling time against initial angle, a panel for each law. " + " ".join(told)


hero = responsive_picture(draw_hero)


def _draw_panel(axes: Axes, panel: Panel, rows: pd.DataFrame, quote_width: int) -> str:
    """Draw one law's starts, with the paper's words above them; return it in words."""
    colour = style.look(panel.contender).colour
    is_uniform, is_settled = rows["start_set"] == "uniform", rows["outcome"] == "settled"
    is_near_180 = rows["start_set"] == "half-turn"
    shown = pd.concat((rows[is_uniform & is_settled].head(DRAWN), rows[is_near_180 & is_settled]))
    style.dots(axes, np.degrees(shown["angle0_rad"]), shown["settling_time_s"], colour, 3.0, alpha=0.45, zorder=3)

    lost = rows[~is_settled]
    places = np.linspace(-ASIDE, ASIDE, max(2, len(lost)))[: len(lost)]
    aside = np.random.default_rng(0).permutation(places)
    style.dots(axes, np.degrees(lost["angle0_rad"]), NEVER * 10.0**aside, colour, 2.6)
    axes.axhspan(RAIL, CEILING, facecolor=style.GRID, alpha=0.45, zorder=0)

    axes.set(yscale="log", xlim=(0, 184), ylim=(LOWEST, CEILING), xticks=[0, 60, 120, 180])
    axes.yaxis.set_major_locator(FixedLocator([*TIMES, NEVER]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_yticklabels([*map(str, TIMES), "never"])

    quote = textwrap.wrap(f"“{panel.quote}” ({panel.section})", quote_width)
    above = QUOTE_LINE_PT * MOST_LINES[quote_width]
    axes.set_title(panel.title, color=colour, pad=above + 6)
    place: dict[str, Any] = {
        "xycoords": "axes fraction",
        "textcoords": "offset points",
        "va": "top",
        "linespacing": 1.0,
    }
    axes.annotate("\n".join(quote), (0.0, 1.0), xytext=(0, above + 2), fontsize=9, **place)

    (random, of_random), (difficult, of_difficult) = count_lost(rows).values()
    words = (
        f"never: {random or 'none'} of {html.number(of_random)} random,",
        f"{difficult or 'none'} of {html.number(of_difficult)} difficult starts",
    )
    axes.text(4, RAIL * 0.93, "\n".join(words), va="top", fontsize=8.5, linespacing=1.0)
    times = rows.loc[is_uniform & is_settled, "settling_time_s"]
    taken = f"; those that do take {times.median():.2f} s (median) to {times.max():.2f} s" if len(times) else ""
    return f"{panel.title} (“{panel.quote}”), {' '.join(words)}{taken}."
