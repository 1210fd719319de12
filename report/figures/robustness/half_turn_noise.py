"""The page on the worst noise at 180°: which laws it holds there, from which noise on, and why.

A law that turns about one axis is a scalar equation there (`isotropic`), and the lie a change of one sign: whether it
is held follows from adding up. A law with memory is held from where its memory ends. The picture has ten laws, and the
page that compares all laws has the others.
"""

import math
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from bench.experiments.tables.run import Run, shown_run
from bench.findings.amounts import join_words
from bench.findings.theory.thresholds import DELTAS, HALF_TURN, keeps, least
from bench.law import DELTA
from bench.law.contenders.registry import find_contender
from bench.law.kinds import Law
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import TITLES, gains
from report.figures.kit.spelling import power
from report.figures.robustness.robustness import along, laws, starts

FOOT, TOP = 1e-4, 1.6
WITHOUT, WITH = "Without memory", "With memory"

SHOWN = (
    *TITLES,
    "quaternion-shortest",
    "mrp",
    "synergistic",
    "mrp-linearized",
    "hybrid",
    "mrp-memory",
    "late-braking",
)
"""The laws in the picture: the paper's three and two later ones without memory, and five with memory."""


def leaving(rows: pd.DataFrame) -> pd.DataFrame:
    """Share of starts that leave and settle under some noise: a row a level, a column a law."""
    noisy = rows[rows["level"] > 0.0]
    return noisy.pivot_table(index="level", columns="contender", values="good", aggfunc="mean", observed=True)


@responsive_picture
def strips(rows: pd.DataFrame, shown: list[str], narrow: bool) -> Drawing:
    """Draw a row a law, without memory above and with memory below, the least tolerant first; rows: of the axis.

    Marks are the episodes, and the strip is the noise that traps the body by theory.
    """
    shares = leaving(rows)
    groups = {title: sort_by_tolerance(rows, laws_of) for title, laws_of in split_by_memory(shown).items()}
    places, titles = place_rows(groups)
    figure, axes = style.panels(height=0.25 * (max(places.values()) + 1.0) + 1.55, narrow=narrow)
    words = []
    for law, place in places.items():
        colour, begin = style.look(law).colour, least(law, *gains(rows))
        is_known = not math.isnan(begin)
        if is_known:
            strip = [max(begin, FOOT), TOP]
            axes.plot(strip, [place] * 2, color=colour, alpha=0.35, linewidth=8, solid_capstyle="butt")
        draw_marks(axes, place, shares[law], colour)
        settled = ", ".join(f"{100 * share:.0f}" for share in shares[law])
        theory = f" (trapped from {begin:.2g} by theory)" if is_known else ""
        words.append(f"{families.word(law)} {settled}{theory}")
    axes.set(xscale="log", xlim=(FOOT, TOP), ylim=(max(places.values()) + 0.7, -0.7))
    axes.set_xlabel("sensor error at 180° [rad]" if narrow else "worst error of the sensor at 180° [rad]")
    heads = {place: title for title, place in titles.items()}
    names = {place: families.word(law) for law, place in places.items()}
    axes.set_yticks([*heads, *names], [*heads.values(), *names.values()], fontsize=10)
    for label in axes.get_yticklabels()[: len(titles)]:
        label.set_fontweight("bold")
    # 0.3 and its like lie too close to their neighbours on a phone
    axes.set_xticks(list(shares.index), ["" if narrow and f"{x:g}"[-1] == "3" else f"{x:g}" for x in shares.index])
    axes.minorticks_off()
    style.listed(axes)
    draw_key(figure, narrow)
    levels = ", ".join(f"{level:g}" for level in shares.index)
    return (
        figure,
        f"Share of starts at 180° that leave it and settle, in per cent, at noise of {levels} rad: {'; '.join(words)}.",
    )


def split_by_memory(laws: list[str]) -> dict[str, list[str]]:
    """Return the laws in two groups under their titles: without memory, and with memory."""
    groups: dict[str, list[str]] = {WITHOUT: [], WITH: []}
    for law in laws:
        groups[WITH if regulator_of(law).memory else WITHOUT].append(law)
    return {title: group for title, group in groups.items() if group}


def sort_by_tolerance(rows: pd.DataFrame, laws: list[str]) -> list[str]:
    """Return the laws by the noise from which some start is trapped, the least first; ties by theory."""
    shares, (kp, kv) = leaving(rows), gains(rows)

    def tolerance(law: str) -> tuple[float, float, float]:
        trapping = shares.index[shares[law] < 1.0]
        begin = least(law, kp, kv)
        first = float(trapping[0]) if len(trapping) else math.inf
        return first, float(shares[law].sum()), -1.0 if math.isnan(begin) else begin

    return sorted(laws, key=tolerance)


def place_rows(groups: dict[str, list[str]]) -> tuple[dict[str, float], dict[str, float]]:
    """Return the height of each law's row, and of each group's title."""
    places, titles, place = {}, {}, 0.0
    for title, laws_of in groups.items():
        titles[title] = place
        for law in laws_of:
            place += 1.0
            places[law] = place
        place += 1.4
    return places, titles


def draw_marks(axes: Axes, place: float, shares: pd.Series, colour: str) -> None:
    """Draw a mark a level: full where no start settles, half full where some do, empty where all do."""
    for level, share in shares.items():
        fill = colour if share == 0.0 else style.PAPER
        axes.plot(level, place, "o", markersize=5.5, markerfacecolor=fill, markeredgecolor=colour, markeredgewidth=1.3)
        if 0.0 < share < 1.0:
            axes.plot(level, place, "o", markersize=5.5, fillstyle="left", color=colour, markerfacecoloralt=style.PAPER)


def draw_key(figure: Figure, narrow: bool) -> None:
    """Say above the picture what the marks and the strip mean."""
    dot: dict[str, Any] = {"marker": "o", "markersize": 5.5, "linestyle": "", "color": style.INK}
    handles = [
        Line2D([], [], **dot, markerfacecolor=style.PAPER),
        Line2D([], [], **dot, fillstyle="left", markerfacecoloralt=style.PAPER),
        Line2D([], [], **dot),
        Line2D([], [], color=style.INK, alpha=0.35, linewidth=8, solid_capstyle="butt"),
    ]
    titles = ["every start settles", "some starts settle", "no start settles", "trapped by theory"]
    figure.legend(handles, titles, loc="outside upper left", ncols=2 if narrow else 4, handletextpad=0.5, fontsize=10)


def regulator_of(law: str) -> Law:
    """Return the regulator of a contender, the user's own of the run among them."""
    return find_contender(law, shown_run().user_laws()).regulator


def count(part: int, of: int) -> str:
    """Return "all 12", "9 of the 12" or "none of the 12"."""
    return f"all {of}" if part == of else f"{part or 'none'} of the {of}"


def trap(noisy: pd.DataFrame, law: str) -> str:
    """Return the share of starts that leave at the first noise at which not all do, in words."""
    trapping = noisy[law][noisy[law] < 1.0]
    share = f"{100 * trapping.iloc[0]:.0f} %" if trapping.iloc[0] else "none"
    return f"the body leaves 180° with {families.word(law)} from {share} of the starts (δ = {trapping.index[0]:g} rad)"


def describe_worst(share: float) -> str:
    """Say from how many starts the body leaves 180° with the worst of some laws."""
    if share == 1.0:
        return "with all these laws, the body leaves 180° from every start"
    return f"with the worst of these laws, the body leaves 180° from {100 * share:.0f} % of these starts"


def describe_trapped(rows: pd.DataFrame) -> str:
    """Say for how many laws without memory the least noise suffices, and what laws that store a side resist."""
    noisy, tested = leaving(rows), laws(rows, controls=False)
    groups = split_by_memory(tested)
    without_memory = groups.get(WITHOUT, [])
    on_a_side = [law for law in tested if law in DELTAS]
    first = float(noisy.index.min())
    trapped = [law for law in without_memory if noisy.loc[first, law] == 0.0]
    resisted = [float(level) for level in noisy.index if (noisy.loc[level, on_a_side] == 1.0).all()]
    return (
        f"Noise of {first:g} rad traps the body at 180° with "
        f"{count(len(trapped), len(without_memory))} laws without memory. With the "
        f"{len(on_a_side)} laws that store a side and whose limit is known, the body leaves 180° "
        f"from every start at noise up to {max(resisted, default=0.0):g} rad"
    )


def facts(run: Run) -> dict:
    """Whom noise holds, by theory and in the episodes, in numbers and drawn; laws with memory and without."""
    rows = along(run, HALF_TURN)
    kp, kv = gains(rows)
    noisy = leaving(rows)
    tested = laws(rows, controls=False)
    known = {law: least(law, kp, kv) for law in tested if not math.isnan(least(law, kp, kv))}
    agree = []
    for law, begin in known.items():
        agree += [(level >= begin) == (noisy.loc[level, law] < 0.5) for level in noisy.index]
    on_a_side = [law for law in tested if law in DELTAS]
    without_memory = [law for law in tested if not regulator_of(law).memory]
    with_memory = [law for law in tested if law not in without_memory]
    # those with a memory that some noise below every kept side's limit traps nevertheless
    below = noisy.loc[noisy.index < min(map(keeps, DELTAS))]
    trapped = [trap(below, law) for law in with_memory if below[law].min() < 1.0]
    jumping = [begin for law, begin in known.items() if law in without_memory and begin > 0.0]
    middle = float(below.index.max())
    return {
        "n": starts(rows),
        "agreement": f"all {len(agree)}" if all(agree) else f"{sum(map(bool, agree))} of the {len(agree)}",
        "middle": f"{middle:g}",
        "without": len(without_memory),
        "blind_middle": f"{100 * float(noisy.loc[middle, without_memory].max()):.0f}",
        "sided": len(on_a_side),
        "memory_middle": describe_worst(float(noisy.loc[middle, on_a_side].min())),
        "caught": join_words(trapped) or "the body also leaves 180° from every start with all other laws with memory",
        "least": power(min(jumping)),
        "most": power(max(jumping)),
        **{law: f"{keeps(law):.2f}" for law in ("hybrid", "late-braking", "mrp-linearized")},
        "delta": f"{DELTA:g}",
        "finding": describe_trapped(rows),
        "tested": len(tested),
        HALF_TURN: strips(rows, [law for law in SHOWN if law in tested]),
    }
