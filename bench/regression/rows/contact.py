"""How tables of hands in contact and of perturbed laws are compared: both are decided by rounding in places."""

import numpy as np
import pandas as pd

from bench.contenders.registry import known_representations
from bench.contenders.representations.zyx_euler import to_matrix
from bench.regression.rows.difference import Difference, aligned, changed, compared, near
from bench.regression.rows.tables import ABSOLUTE
from bench.tables.schema import TABLES
from tasks.verdict import OUTCOMES, SETTLED

ON_SET = 1e-6
"""Margin of coordinates: a goal that is nearer to their singular set is meant to be on it."""

THROWN = 1.0
"""Torque over its rated one: a hand that asks more of its motors has been thrown about; what it hits next, and when,
hangs on rounding."""

CONTACT_RELATIVE, CONTACT_ABSOLUTE = 1e-4, 1e-7
"""Impacts multiply rounding: 1e-16 in a joint angle becomes 4e-7 in the peak of the force on a peg that jams, and each
tick rounds anew. A rotation [rad] by its cosine is known to 2e-8."""

PEG, TRANSPOSE = "peg-in-hole", "transpose"
PEG_RELATIVE, PEG_ABSOLUTE = 1e-3, 1e-5
"""Of pegs by the Jacobian transpose, which cancels no impact: they hit the hole's edges again and again, and another
processor's libraries moved the error of a moment by 1.2e-4 of it, a rotation about held axes by 8e-6 rad."""

PERTURBED_RELATIVE = 1e-4
"""A law that jumps at half turns, asked there with noise, chooses its side by the last bit; what settles all the same
has been driven on by its goal or its noise for five thousand steps."""


def compliance(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Hands in contact: outcomes where no rounding decides them, numbers of what is done in both."""
    table = TABLES["compliance"]
    old, new, found = aligned(table, old, new)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    torque = np.fmin(new["peak_torque_ratio"].to_numpy(), old["peak_torque_ratio"].to_numpy())
    decided = ~_on_singular_set(old) & ~(torque > THROWN)
    found += changed(table, "outcome", old, new, ~same & decided)
    both = same & decided & (old["outcome"].astype(str) == "done")
    is_peg = (old["task"].astype(str) == PEG) & (old["form"].astype(str) == TRANSPOSE)
    close = near(np.where(is_peg, PEG_RELATIVE, CONTACT_RELATIVE), np.where(is_peg, PEG_ABSOLUTE, CONTACT_ABSOLUTE))
    return found + compared(table, old, new, close, both, ["outcome"])


def robustness(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Laws under perturbations: outcomes exactly, numbers of what settled in both."""
    table = TABLES["robustness"]
    old, new, found = aligned(table, old, new)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    found += changed(table, "outcome", old, new, ~same)
    settled = same & (old["outcome"].astype(str) == OUTCOMES[SETTLED])
    return found + compared(table, old, new, near(PERTURBED_RELATIVE, ABSOLUTE), settled, ["outcome"])


def _on_singular_set(rows: pd.DataFrame) -> np.ndarray:
    """Whether a row's goal is where its controller's coordinates are singular."""
    margins = {name: one.margin for name, one in known_representations().items()}
    goals = zip(rows["representation"].astype(str), rows["alpha"], rows["beta"], rows["gamma"], strict=True)
    return np.array([bool(name) and margins[name](to_matrix(E)) < ON_SET for name, *E in goals], bool)
