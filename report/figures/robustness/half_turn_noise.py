"""The page on the worst noise at 180°: which laws it holds there, from which noise on, and why.

A law that turns about one axis is a scalar equation there (`isotropic`), and the lie a change of one sign: whether it
is held follows from adding up. A law with memory is held from where its memory ends.
"""

import math

import pandas as pd
from matplotlib.axes import Axes

from bench.experiments.tables import read
from bench.findings.theory.thresholds import DELTAS, HALF_TURN, keeps, least
from bench.law import DELTA
from bench.law.contenders.registry import find_contender
from bench.law.kinds import Law
from report.figures.kit import families, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import gains
from report.figures.kit.page import Run
from report.figures.robustness.robustness import along, laws, starts

FOOT, TOP = 1e-4, 1.6


def leaving(rows: pd.DataFrame) -> pd.DataFrame:
    """Share of starts that leave and settle under some noise: a row a level, a column a law."""
    noisy = rows[rows["level"] > 0.0]
    return noisy.pivot_table(index="level", columns="contender", values="good", aggfunc="mean", observed=True)


@responsive_picture
def strips(rows: pd.DataFrame, narrow: bool) -> Drawing:
    """Draw a row a law: in colour the noise that holds it by theory; marks: the episodes, full where all are held."""
    shares = leaving(rows)
    own = laws(rows, controls=False)
    figure, axes = style.panels(height=0.2 * len(own) + 0.9, narrow=narrow)
    words = []
    for place, law in enumerate(own):
        colour, begin = style.look(law).colour, least(law, *gains(rows))
        if not math.isnan(begin):
            axes.plot(
                [max(begin, FOOT), TOP], [place] * 2, color=colour, alpha=0.35, linewidth=7, solid_capstyle="butt"
            )
        _marks(axes, place, shares[law], colour)
        settled = ", ".join(f"{100 * share:.0f}" for share in shares[law])
        words.append(
            f"{families.word(law)} {settled}" + ("" if math.isnan(begin) else f" (held from {begin:.2g} by theory)")
        )
    axes.set(xscale="log", xlim=(FOOT, TOP), ylim=(len(own) - 0.4, -0.6), xlabel="worst noise at 180° [rad]")
    axes.set_yticks(range(len(own)), map(families.word, own), fontsize=8.5)
    # 0.3 and its like lie too close to their neighbours on a phone
    axes.set_xticks(list(shares.index), ["" if narrow and f"{x:g}"[-1] == "3" else f"{x:g}" for x in shares.index])
    axes.minorticks_off()
    style.listed(axes)
    levels = ", ".join(f"{level:g}" for level in shares.index)
    return (
        figure,
        f"Share of starts at 180° that leave it and settle, in per cent, at noise of {levels} rad: {'; '.join(words)}.",
    )


def _marks(axes: Axes, place: int, shares: pd.Series, colour: str) -> None:
    for level, share in shares.items():
        fill = colour if share == 0.0 else style.PAPER
        axes.plot(level, place, "o", markersize=5, markerfacecolor=fill, markeredgecolor=colour, markeredgewidth=1.3)
        if 0.0 < share < 1.0:
            axes.plot(level, place, "o", markersize=5, fillstyle="left", color=colour, markerfacecoloralt=style.PAPER)


def regulator_of(law: str) -> Law:
    """Return the regulator of a contender, the user's own of the run among them."""
    return find_contender(law, read.own_laws()).regulator


def describe_caught(shares: pd.DataFrame, laws: list[str]) -> str:
    """Return which laws with a memory noise holds, and the share of starts that leave at the level where it begins."""
    told = []
    for law in laws:
        share = shares[law][shares[law] < 1.0].iloc[0]
        level = shares[law][shares[law] < 1.0].index[0]
        told.append(f"{families.word(law)} leaves 180° from {100 * share:.0f} % of them at δ = {level:g} rad")
    return "; ".join(told) or "none does not leave"


def facts(run: Run) -> dict:
    """Whom noise holds, by theory and in the episodes, in numbers and drawn; laws with memory and without."""
    rows = along(run, HALF_TURN)
    kp, kv = gains(rows)
    noisy = leaving(rows)
    own = laws(rows, controls=False)
    known = {law: least(law, kp, kv) for law in own if not math.isnan(least(law, kp, kv))}
    agree = [(level >= begin) == (noisy.loc[level, law] < 0.5) for law, begin in known.items() for level in noisy.index]
    on_a_side = [law for law in own if law in DELTAS]
    without_memory = [law for law in own if not regulator_of(law).memory]
    with_memory = [law for law in own if law not in without_memory]
    # those with a memory that some noise below every kept side's limit holds nevertheless
    caught = [law for law in with_memory if noisy.loc[noisy.index < min(map(keeps, DELTAS)), law].min() < 1.0]
    jumping = [begin for law, begin in known.items() if law in without_memory and begin > 0.0]
    middle = float(noisy.index[noisy.index < min(map(keeps, DELTAS))].max())
    return {
        "n": starts(rows),
        "agreement": f"all {len(agree)}" if all(agree) else f"{sum(map(bool, agree))} of the {len(agree)}",
        "middle": f"{middle:g}",
        "blind_middle": f"{100 * float(noisy.loc[middle, without_memory].max()):.0f}",
        "sided": len(on_a_side),
        "memory_middle": f"{100 * float(noisy.loc[middle, on_a_side].min()):.0f}",
        "caught": describe_caught(noisy, caught),
        "least": f"{min(jumping):.2g}",
        "most": f"{max(jumping):.2g}",
        **{law: f"{keeps(law):.3f}" for law in ("hybrid", "late-braking", "mrp-linearized")},
        "delta": f"{DELTA:g}",
        HALF_TURN: strips(rows),
    }
