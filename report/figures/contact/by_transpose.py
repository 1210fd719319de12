"""Leakage by the paper's force control on the Euler Jacobian: two complying axes and a moment about x, over beta.

    leakage   |(1 - r) tan beta - r A_zx/A_xx|,  r = sprung(t)/free(t)

The formulas are those of `compliance_theory`; A is the arm's own inertia, inverted.
"""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

import tasks
from bench.findings.theory import compliance_theory as theory
from bench.law.control.setpoint import ContactParameters
from bench.law.inputs import Gains
from report.figures.contact import rows as controllers
from report.figures.kit.spelling import power

ORDER = "about x and y"
LISTED = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0)
"""Degrees, at most 75: with an inertia of its own the hand turns by ten milliradians, a ninth of the way left at 85."""


def levels(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the listed betas of each arm: turn = c_xx [rad/(N m)], leak = |c_zx/c_xx| and its closed form."""
    own = controllers.level(controllers.of(rows, controllers.PAPERS_EULER, ORDER))
    own = own[own["beta_deg"].isin(controllers.nearest(own, LISTED)) & (own["beta_deg"] <= LISTED[-1])]
    own = own.drop_duplicates(["arm", "beta_deg"]).sort_values(["arm", "beta_deg"])
    theories = [predict(row) for _, row in own.iterrows()]
    return own.assign(turn=own["c_xx"], leak=(own["c_zx"] / own["c_xx"]).abs(), theory=theories)


def predict(row: pd.Series) -> float:
    """Return the closed form of what leaks, with the constants of a row."""
    gains = Gains(*(row[name] for name in Gains._fields))
    touch = ContactParameters(*(row[name] for name in ContactParameters._fields))
    mobility = theory.mobility(tasks.arm(row["arm"]))
    return theory.leakage_by_transpose(math.radians(row["beta_deg"]), mobility, row["horizon_s"], gains, touch)


def facts(rows: pd.DataFrame) -> dict[str, str]:
    """Return the gain, how level c_xx is over beta, and how far theory and measurement are apart."""
    near = levels(rows)
    if near.empty:
        return {}
    turns = near.groupby("arm")["turn"]
    return {
        "kf": f"{near['kf'].iloc[0]:g}",
        "transpose_spread": power(float((turns.agg(np.ptp) / turns.first()).max())),
        "transpose_gap": power(float((near["leak"] - near["theory"]).abs().max())),
        "transpose_to": f"{LISTED[-1]:g}°",
    }
