"""The paper's force control beside commanded accelerations: two complying axes and a moment about x, over beta.

    c_xx      Jacobian transpose   (1 + kf) free(t) A_xx                            at any beta
              accelerations        free(t) cos^2 beta / m_o
    leakage   Jacobian transpose   |(1 - r) tan beta - r A_zx/A_xx|,  r = sprung(t)/free(t)
              accelerations        tan |beta|

The formulas are those of `compliance_theory`; A is the arm's own inertia, inverted.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pandas as pd

import tasks
from bench.findings.theory import compliance_theory as theory
from bench.law.contender import Gains
from bench.law.control.contact_controller import PAPERS_FORM
from bench.law.control.setpoint import ContactParameters
from report.figures.arms import arm_looks
from report.figures.contact import rows as controllers
from report.figures.kit import html
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table

ORDER = "about x and y"
LISTED = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0)
COMPARED_TO = 75.0
"""Degrees. With an inertia of its own the hand turns by ten milliradians: a ninth of what 85 leave to the pole."""

TABLE = Table(
    "Arm | β [deg] | Turn, Jᵀ [rad/(N m)]:.3f | Leaks, Jᵀ:.3f | Theory, Jᵀ:.3f | Leaks, Cartesian Jᵀ:.3f | "
    "Theory, Cartesian Jᵀ:.3f | Turn, accelerations [rad/(N m)]:.3f | Leaks, accelerations:.3f | tan β:.3f"
)


class Level(NamedTuple):
    """A frame of the hand on an arm: c_xx [rad/(N m)] and |c_zx / c_xx|, measured, and theory of the latter."""

    arm: str
    beta: float
    turn: float
    leak: float
    theory: float
    base_leak: float
    base_theory: float
    other_turn: float
    other_leak: float
    tan: float


def levels(rows: pd.DataFrame) -> list[Level]:
    """The listed betas of each arm, alpha = gamma = 0, where two axes comply; none where a controller has no row."""
    own = controllers.level(rows[rows["complies"] == ORDER])
    asked = (controllers.PAPERS_EULER, controllers.PAPERS, controllers.EULER)
    found = []
    for arm, beta in ((arm, beta) for arm in controllers.arms(own) for beta in controllers.nearest(own, LISTED)):
        there = own[(own["arm"] == arm) & (own["beta_deg"] == beta)].drop_duplicates("contender").set_index("contender")
        if not set(asked) <= set(there.index):
            continue
        papers, base, other = (there.loc[name] for name in asked)
        leak, base_leak, other_leak = (abs(one["c_zx"] / one["c_xx"]) for one in (papers, base, other))
        found.append(
            Level(
                *(arm, beta, papers["c_xx"], leak, predicted(papers, math.radians(beta))),
                *(base_leak, predicted(base, 0.0), other["c_xx"], other_leak, abs(math.tan(math.radians(beta)))),
            )
        )
    return found


def predicted(row: pd.Series, beta: float) -> float:
    """The closed form of what leaks by the Jacobian transpose, with the constants of a row."""
    gains = Gains(*(row[name] for name in Gains._fields))
    touch = ContactParameters(*(row[name] for name in ContactParameters._fields))
    return theory.leakage_by_transpose(beta, theory.mobility(tasks.arm(row["arm"])), row["horizon_s"], gains, touch)


def table(rows: pd.DataFrame) -> html.Markdown | None:
    """A line an arm and beta."""
    return TABLE([(one.arm, f"{one.beta:.0f}", *one[2:]) for one in levels(rows)])


def facts(rows: pd.DataFrame) -> dict[str, str]:
    """The gain, how level c_xx is over beta, and how far theory and measurement are apart."""
    near = [one for one in levels(rows) if one.beta <= COMPARED_TO]
    if not near:
        return {}
    own = rows[rows["form"] == PAPERS_FORM]
    turns = [[one.turn for one in near if one.arm == arm] for arm in dict.fromkeys(one.arm for one in near)]
    spread = max(np.ptp(each) / each[0] for each in turns)
    gap = max(abs(one.leak - one.theory) for one in near)
    return {
        "kf": f"{own['kf'].iloc[0]:g}",
        "transpose_spread": power(spread),
        "transpose_gap": power(gap),
        "transpose_to": f"{COMPARED_TO:g}°",
        "yields": most_yielding(near),
    }


def most_yielding(near: list[Level]) -> str:
    """Which arm's hand turns furthest about x by a moment where its frame is level, and how much further than which."""
    turns = {one.arm: one.turn for one in reversed(near)}
    if len(turns) < 2:
        return "These are rows of one arm."
    most, least = (pick(turns, key=turns.__getitem__) for pick in (max, min))
    further = turns[most] / turns[least]
    return (
        "Arms differ by their inertia alone, with seven joints as with six: a moment turns the hand of the "
        f"{arm_looks.title(most)} {further:.0f} times as far as that of the {arm_looks.title(least)}."
    )
