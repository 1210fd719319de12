"""The worst noise at the half turn: which laws it holds there, from which noise on, and what a recurrence says of it.

A law that turns about one axis is a scalar equation there (`isotropic`), and the lie a change of one sign: whether it
is held follows from adding up. A law with memory is held from where its memory ends.
"""

from __future__ import annotations

import functools
import math

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from bench.contenders.registry import find_contender
from bench.contenders.regulators import hybrid, mrp_linearized
from bench.findings.theory import robustness_theory
from bench.findings.theory.isotropic import EQUATIONS
from bench.law.contender import Regulator
from bench.tables import read
from report.figures.kit import families, html, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.spelling import power
from report.figures.robustness import robustness_rows

KEEPS = {
    "hybrid": 2.0 * math.asin(hybrid.DELTA),
    "late-braking": math.pi / 3.0,
    "mrp-linearized": 4.0 * math.atan(math.sqrt(mrp_linearized.SWITCH)) - math.pi,
}
"""Law with memory -> angle [rad] beyond the half turn up to which it keeps to the way it has begun."""

UNBOUNDED = tuple(law for law, equation in EQUATIONS.items() if not equation.is_bounded)
"""Laws without a greatest command: at the half turn they have none that a tick could hold."""

FOOT, TOP = 1e-4, 1.6
STEPS = 16
"""Halvings of the interval that holds the least noise: to 1e-4 of it on a scale of factors."""


def least(law: str, kp: float, kv: float) -> float:
    """Least noise [rad] that holds a law at the half turn, by its equation or memory; 0 if any does, NaN if unknown."""
    if law in KEEPS:
        return KEEPS[law]
    if law not in EQUATIONS or law in UNBOUNDED or find_contender(law).regulator.memory:
        return math.nan
    return _least(law, kp, kv)


@functools.cache
def _least(law: str, kp: float, kv: float) -> float:
    equation = EQUATIONS[law]
    low, high = math.log(1e-6), math.log(1.0)
    if robustness_theory.is_held(equation, kp, kv, math.exp(low)):
        return 0.0
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        held = robustness_theory.is_held(equation, kp, kv, math.exp(middle))
        low, high = (low, middle) if held else (middle, high)
    return math.exp(high)


def jump(law: str, kp: float) -> float:
    """Half the jump of a law's command at the half turn [rad/s^2], of a law with a scalar equation; NaN of others."""
    return kp * EQUATIONS[law].spring(math.pi) if law in EQUATIONS and law not in UNBOUNDED else math.nan


def leaving(rows: pd.DataFrame) -> pd.DataFrame:
    """Share of starts that leave and settle: a row a level, a column a law."""
    return rows.pivot_table(index="level", columns="contender", values="good", aggfunc="mean", observed=True)


@responsive_picture
def strips(rows: pd.DataFrame, narrow: bool):
    """A row a law: in colour the noise that holds it by theory; marks are the episodes, full where all are held.

    Args:
        rows: of `robustness_rows.along("half-turn-noise")`.
    """
    kp, kv = robustness_rows.gains(rows)
    shares = leaving(rows)
    shares = shares[shares.index > 0]
    laws = [law for law in robustness_rows.laws(rows) if law not in families.CONTROLS]
    figure, axes = style.panels(height=0.25 * len(laws) + 0.9, narrow=narrow)
    said = []
    for place, law in enumerate(laws):
        colour, begin = style.look(law).colour, least(law, kp, kv)
        if not math.isnan(begin):
            axes.plot(
                [max(begin, FOOT), TOP], [place] * 2, color=colour, alpha=0.35, linewidth=7, solid_capstyle="butt"
            )
        _marks(axes, place, shares[law], colour)
        settled = ", ".join(f"{100 * share:.0f}" for share in shares[law])
        said.append(
            f"{families.word(law)} {settled}" + ("" if math.isnan(begin) else f" (held from {begin:.2g} by theory)")
        )
    axes.set(xscale="log", xlim=(FOOT, TOP), ylim=(len(laws) - 0.4, -0.6), xlabel="worst noise at the half turn [rad]")
    axes.set_yticks(range(len(laws)), map(families.word, laws), fontsize=9)
    # 0.3 and its like lie too close to their neighbours on a phone
    axes.set_xticks(list(shares.index), ["" if narrow and f"{x:g}"[-1] == "3" else f"{x:g}" for x in shares.index])
    axes.minorticks_off()
    axes.tick_params(axis="y", length=0)
    axes.grid(visible=False, axis="y")
    levels = ", ".join(f"{level:g}" for level in shares.index)
    return (
        figure,
        f"Share of half turns that is left and settled, in per cent, at noise of {levels} rad: {'; '.join(said)}.",
    )


def _marks(axes: Axes, place: int, shares: pd.Series, colour: str) -> None:
    for level, share in shares.items():
        fill = colour if share == 0.0 else style.PAPER
        axes.plot(level, place, "o", markersize=6, markerfacecolor=fill, markeredgecolor=colour, markeredgewidth=1.3)
        if 0.0 < share < 1.0:
            axes.plot(level, place, "o", markersize=6, fillstyle="left", color=colour, markerfacecoloralt=style.PAPER)


def regulator_of(law: str) -> Regulator:
    """The regulator of a contender, the user's own of the run among them."""
    return find_contender(law, read.own_laws()).regulator


def table(rows: pd.DataFrame) -> html.Markdown:
    """A law a row: its property, half the jump of its command, the least noise by theory, and what was measured.

    Args:
        rows: of `robustness_rows.along("half-turn-noise")`.
    """
    kp, kv = robustness_rows.gains(rows)
    shares, lines = leaving(rows), []
    for law in robustness_rows.laws(rows):
        regulator, begin = regulator_of(law), least(law, kp, kv)
        lines.append(
            {
                "Law": families.link(law, families.word(law)),
                "Proved": html.foreign(regulator.property),
                "Memory": "yes" if regulator.memory else "no",
                "Jump [rad/s²]": 2.0 * jump(law, kp),
                "Held from, by theory [rad]": begin,
                "Exact half turns left [%]": 100.0 * float(shares[law].get(0.0, np.nan)),
                "Measured": measured(shares[law]),
            }
        )
    forms: dict = {"Jump [rad/s²]": ".0f", "Held from, by theory [rad]": _noise, "Exact half turns left [%]": ".0f"}
    return html.table(pd.DataFrame(lines), forms)


def _noise(value: float) -> str:
    return "any" if value == 0.0 else power(value) if value < 1e-3 else f"{value:.3g}"


def measured(shares: pd.Series) -> str:
    """Between which levels a law begins to be held: at the first it leaves all starts, at the second it does not."""
    noisy = shares[shares.index > 0]
    held = noisy.index[noisy < 1.0]
    if not len(held):
        return "never held"
    free = noisy.index[noisy.index < held[0]]
    begin = "any" if not len(free) else f"{free[-1]:g} to {held[0]:g}"
    return begin if (noisy[noisy.index >= held[0]] == 0.0).all() else f"{begin}, in part"


def facts(rows: pd.DataFrame) -> dict:
    """Of the page."""
    kp, kv = robustness_rows.gains(rows)
    shares = leaving(rows)
    noisy = shares[shares.index > 0]
    laws = [law for law in noisy if law not in families.CONTROLS]
    known = {law: least(law, kp, kv) for law in laws if not math.isnan(least(law, kp, kv))}
    told = [
        (bool(level >= begin), bool(noisy.loc[level, law] < 0.5))
        for law, begin in known.items()
        for level in noisy.index
    ]
    minding = [law for law in laws if regulator_of(law).memory]
    blind = [law for law in laws if law not in minding]
    jumping = {law: begin for law, begin in known.items() if law in blind and begin > 0.0}
    middle = float(noisy.index[noisy.index < min(KEEPS.values())].max())
    chord, chord_least = jump("square-root", kp), least("square-root", kp, kv)
    return {
        "n": int(rows.groupby(["contender", "level"], observed=True).size().max()),
        "agree": sum(one == other for one, other in told),
        "told": len(told),
        "known": len(known),
        "minding": len(minding),
        "blind": len(blind),
        "blind_free": sum(bool((noisy[law] == 1.0).all()) for law in blind),
        "middle": f"{middle:g}",
        "blind_middle": f"{100 * float(noisy.loc[middle, blind].max()):.0f}",
        "memory_middle": f"{100 * float(noisy.loc[middle, minding].min()):.0f}",
        "stuck": int((shares.loc[0.0, laws] < 1.0).sum()),
        "least": f"{min(jumping.values()):.2g}",
        "most": f"{max(jumping.values()):.2g}",
        "chord": f"{chord:g}",
        "chord_least": f"{robustness_theory.two_ticks(chord, kv):.3g}",
        "chord_exact": f"{chord_least:.3g}",
        "faster": power(chord_least / 100.0),
        "hybrid": f"{KEEPS['hybrid']:.3f}",
        "hybrid_deg": f"{math.degrees(KEEPS['hybrid']):.0f}",
        "delta": f"{hybrid.DELTA:g}",
        "late": f"{KEEPS['late-braking']:.3f}",
        "late_deg": f"{math.degrees(KEEPS['late-braking']):.0f}",
        "mrp": f"{KEEPS['mrp-linearized']:.3f}",
        "mrp_deg": f"{math.degrees(KEEPS['mrp-linearized']):.0f}",
        "switch": f"{mrp_linearized.SWITCH:g}",
    }
