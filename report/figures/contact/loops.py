"""A closed loop of moments about x, y, -x and -y: what is left of the hand's turn, over the hand's frames."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.theory import compliance_theory as theory
from report.figures.contact.rows import look, title, ways
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

SHOWN = ("hybrid-base", "hybrid-hand", "hybrid-rate", "hybrid/zyx-euler")
FORM = "inverse"
COLUMNS = (("loop_drift_rad", "Left about the held axis"), ("loop_rest_rad", "Left in all"))
FLOOR_DEG = 1e-3


def in_form(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of the controllers that are shown, by J^-1."""
    return rows[(rows["form"] == FORM) & rows["way"].isin(SHOWN)]


@responsive_picture
def left_over(rows: pd.DataFrame, narrow: bool):
    """Two panels over beta, a line a controller: the median of arms and ways round; small marks are loops.

    Args:
        rows: of compliance-loop.
    """
    own = in_form(rows)
    figure, panels = style.beside(2, 3.5, 6.4, narrow, sharey=True)
    for axes, (column, head) in zip(panels, COLUMNS, strict=True):
        for way in (one for one in ways(own) if one in SHOWN):
            mine, drawn = own[own["way"] == way], look(way)
            values = np.degrees(mine[column]).clip(lower=FLOOR_DEG)
            middle = values.groupby(mine["beta_deg"]).median()
            axes.plot(middle.index, middle, color=drawn.colour, linestyle=drawn.line, label=title(way))
            axes.plot(mine["beta_deg"], values, drawn.marker, color=drawn.colour, markersize=3.2, alpha=0.7)
        axes.set(yscale="log", xlabel="β [deg]")
        axes.set_title(head, fontweight="normal")
        axes.set_xticks(sorted(set(own["beta_deg"]))[:: 1 if own["beta_deg"].nunique() < 10 else 4])
        axes.minorticks_off()
    panels[0].set_ylabel("rotation [deg]")
    if narrow:
        panels[1].set_ylabel("rotation [deg]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=1 if narrow else 2)
    return figure, f"What a closed loop of moments leaves about the axis that is held, in degrees. {sentence(own)}."


def sentence(rows: pd.DataFrame) -> str:
    """The medians about the held axis at the least and the greatest beta, by controller."""
    words = []
    for way in ways(rows):
        by_beta = np.degrees(rows[rows["way"] == way].groupby("beta_deg")["loop_drift_rad"].median())
        ends = (
            f"{by_beta.iloc[0]:.2g} at beta {by_beta.index[0]:.0f}, {by_beta.iloc[-1]:.2g} at {by_beta.index[-1]:.0f}"
        )
        words.append(f"{title(way)}: {ends}")
    return "; ".join(words)


def facts(rows: pd.DataFrame) -> dict[str, str]:
    """Numbers for the page: the drift of a turn held by its rate, theory's beside it, and what the others leave."""
    own = in_form(rows)
    median = {way: np.degrees(own[own["way"] == way]["loop_drift_rad"].median()) for way in SHOWN}
    euler = np.degrees(own[own["way"] == "hybrid/zyx-euler"].groupby("beta_deg")["loop_drift_rad"].median())
    level, leaning = min(euler.index, key=abs), euler.idxmax()
    side = turned_by_a_leg(own)
    return {
        "loop_side": f"{math.degrees(side):.1f}",
        "loop_theory": f"{math.degrees(float(np.linalg.norm(theory.square_loop(side)))):.2f}",
        "loop_rate": f"{median['hybrid-rate']:.2f}",
        "loop_base": f"{median['hybrid-base']:.2g}",
        "loop_hand": f"{median['hybrid-hand']:.1g}",
        "loop_e0": f"{euler[level]:.1g}",
        "loop_e": f"{euler[leaning]:.0f}° at β = {leaning:.0f}°",
    }


def turned_by_a_leg(rows: pd.DataFrame) -> float:
    """Angle [rad] that a hand which complies has turned by once a moment and its stopping are over.

    m T/(kc m_o) after T, the time of a leg: it moves at m/(kc m_o), and what it lags behind at first it makes up for
    when the next leg begins.
    """
    from tasks.domains.compliance_loop import LOOPS, PUSH

    one = rows.iloc[0]
    return PUSH * float(one["horizon_s"]) / len(next(iter(LOOPS.values()))) / (float(one["kc"]) * float(one["m_o"]))
