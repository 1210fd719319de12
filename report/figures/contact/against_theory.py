"""Measured against theory over beta: leakage, the compliance that is lost, and how unlike in its axes the stiffness is.

    leakage             tan |beta|                             two Euler axes comply, about x and y
    least yield         1 - |sin beta|                         of that at beta = 0: B B^T, its least singular value
    condition number    (1 + |sin beta|)/(1 - |sin beta|)      springs along Euler angles, B^-T B^-1

The formulas are those of `compliance_theory`.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.findings.theory import compliance_theory as theory
from report.figures.contact.rows import SPRINGS_OF_EULER, level, of

COMPARED_TO = 85.0
"""Degrees of |beta|. On its way the hand turns by some milliradians, and to the pole there are 17 at 89 degrees."""


def leakage(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of two Euler axes that comply, and what leaks into the third."""
    own = level(rows[rows["way"] == "hybrid/zyx-euler"])
    own = own[own["complies"] == "about x and y"]
    return own.assign(value=own["leakage_ratio"])


def least_yield(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of springs along Euler angles, and their least yield over that at beta = 0."""
    own = level(of(rows, SPRINGS_OF_EULER))
    at_zero = own[own["beta_deg"] == 0.0].groupby("arm")["least_yield_rad_per_nm"].first()
    return own.assign(value=own["least_yield_rad_per_nm"] / own["arm"].map(at_zero).astype(float))


def condition(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of springs along Euler angles, and the condition number of their stiffness."""
    own = level(of(rows, SPRINGS_OF_EULER))
    return own.assign(value=own["stiffness_condition"])


LAWS = {
    "leakage": (leakage, theory.leakage),
    "least-yield": (least_yield, theory.least_yield),
    "condition": (condition, theory.stiffness_condition),
}
"""What is measured of rows of wrench-probe, and what theory says of |beta| [rad]."""


def gaps(rows: pd.DataFrame) -> dict[str, float]:
    """Largest relative difference of measured and predicted, up to COMPARED_TO degrees, of each law."""
    found = {}
    for name, (measured, predicted) in LAWS.items():
        own = measured(rows)
        beta = np.radians(own["beta_deg"].abs())
        near = (beta > 0.0) & (own["beta_deg"].abs() <= COMPARED_TO)
        found[name] = float((own["value"] / beta.map(predicted) - 1.0)[near].abs().max())
    return found
