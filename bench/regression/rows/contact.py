"""How tables of hands in contact and of perturbed laws are compared: both are decided by rounding in places."""

import numpy as np
import pandas as pd

from bench.contenders.registry import known_representations
from bench.contenders.representations.zyx_euler import to_matrix
from bench.regression.rows.difference import Difference, aligned, changed
from bench.regression.rows.tables import ABSOLUTE
from bench.tables.schema import TABLES
from tasks.verdict import OUTCOMES, SETTLED

COMPLIANCE_KEY, ROBUSTNESS_KEY = TABLES["compliance"].key, TABLES["robustness"].key

ON_SET = 1e-6
"""Margin of coordinates: a goal that is nearer to their singular set is meant to be on it."""

THROWN = 1.0
"""Torque over its rated one: a hand that asks more of its motors has been thrown about; what it hits next, and when,
hangs on rounding."""

CONTACT_RELATIVE, CONTACT_ABSOLUTE = 1e-4, 1e-7
"""Impacts multiply rounding: 1e-16 in a joint angle becomes 4e-7 in the peak of the force on a peg that jams, and each
tick rounds anew. A rotation [rad] by its cosine is known to 2e-8."""

PERTURBED_RELATIVE = 1e-4
"""A law that jumps at half turns, asked there with noise, chooses its side by the last bit; what settles all the same
has been driven on by its goal or its noise for five thousand steps."""


def compliance(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Hands in contact: outcomes where no rounding decides them, numbers of what is done in both."""
    table = "compliance"
    old, new, found = aligned(table, old, new, COMPLIANCE_KEY)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    torque = np.fmin(new["peak_torque_ratio"].to_numpy(), old["peak_torque_ratio"].to_numpy())
    decided = ~_on_singular_set(old) & ~(torque > THROWN)
    found += changed(table, "outcome", old, new, ~same & decided, COMPLIANCE_KEY)
    both = same & decided & (old["outcome"].astype(str) == "done")
    for name in old.columns.difference([*COMPLIANCE_KEY, "outcome"], sort=False):
        if old[name].dtype.kind in "iuf":
            a, b = new[name].to_numpy(float), old[name].to_numpy(float)
            close = np.isclose(a, b, rtol=CONTACT_RELATIVE, atol=CONTACT_ABSOLUTE, equal_nan=True)
            found += changed(table, name, old, new, both & ~close, COMPLIANCE_KEY)
        else:
            differs = new[name].astype(str) != old[name].astype(str)
            found += changed(table, name, old, new, differs, COMPLIANCE_KEY)
    return found


def robustness(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Laws under perturbations: outcomes exactly, numbers of what settled in both."""
    table = "robustness"
    old, new, found = aligned(table, old, new, ROBUSTNESS_KEY)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    found += changed(table, "outcome", old, new, ~same, ROBUSTNESS_KEY)
    settled = same & (old["outcome"].astype(str) == OUTCOMES[SETTLED])
    for name in old.columns.difference([*ROBUSTNESS_KEY, "outcome"], sort=False):
        a, b = new[name].to_numpy(float), old[name].to_numpy(float)
        close = np.isclose(a, b, rtol=PERTURBED_RELATIVE, atol=ABSOLUTE, equal_nan=True)
        found += changed(table, name, old, new, settled & ~close, ROBUSTNESS_KEY)
    return found


def _on_singular_set(rows: pd.DataFrame) -> np.ndarray:
    """Whether a row's goal is where its controller's coordinates are singular."""
    margins = {name: one.margin for name, one in known_representations().items()}
    goals = zip(rows["representation"].astype(str), rows["alpha"], rows["beta"], rows["gamma"], strict=True)
    return np.array([bool(name) and margins[name](to_matrix(E)) < ON_SET for name, *E in goals], bool)
