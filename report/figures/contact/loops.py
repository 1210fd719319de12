"""A closed loop of moments about x, y, -x and -y: what is left of the hand's turn about the held axis."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from bench.findings.theory import compliance_theory as theory

SHOWN = ("hybrid-base", "hybrid-hand", "hybrid-rate", "hybrid/zyx-euler")
FORM = "inverse"


def in_form(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of the controllers that are shown, by J^-1."""
    return rows[(rows["form"] == FORM) & rows["way"].isin(SHOWN)]


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
