"""How tables of hands in contact and of perturbed laws are compared: both are decided by rounding in places."""

import numpy as np
import pandas as pd

from bench.contenders.registry import known_representations
from bench.contenders.representations.zyx_euler import to_matrix
from bench.regression.rows.difference import Close, Difference, aligned, changed, compared, near
from bench.regression.rows.tables import ABSOLUTE
from bench.tables.schema import table_of
from tasks.contact_rest import REST
from tasks.verdict import OUTCOMES, SETTLED

ON_SET = 1e-6
"""Margin of coordinates: a goal that is nearer to their singular set is meant to be on it."""

CREEPING = "creeping"

THROWN = 1.0
"""Torque over its rated one: a hand that asks more of its motors has been thrown about; what it hits next, and when,
hangs on rounding."""

CONTACT_RELATIVE, CONTACT_ABSOLUTE = 1e-4, 1e-7
"""Impacts multiply rounding: 1e-16 in a joint angle becomes 4e-7 in the peak of the force on a peg that jams, and each
tick rounds anew. A rotation [rad] by its cosine is known to 2e-8."""

PEG, CANCELLING = "peg-in-hole", ("inverse", "projected")
PEG_RELATIVE, PEG_ABSOLUTE = 1e-3, 1e-5
"""Of pegs by the Jacobian transpose or an impedance, which cancel no impact: they hit the hole's edges again and again,
and another processor's libraries moved an overshoot by 6e-4 of it, a rotation about held axes by 8e-6 rad."""

CREEP_RELATIVE, CREEP_ABSOLUTE = 1e-2, 1e-4
"""Of what creeps: a peg that sticks and slips for the whole horizon. Without fused multiply-add in the C library's sine
one went 1.6e-4 of its depth less far, and turned by 0.5 % less about a held axis."""

ENDS = {
    "remaining_speed_m_per_s": (0.1, REST.speed),
    "remaining_rate_rad_per_s": (0.1, REST.rate),
    "time_to_rest_s": (0.0, REST.hold_s),
}
"""How an episode ends, relative and absolute. A speed below the bound of rest is that of a last shiver, above it that
of one slip among many (by 4 % on the peg above); one shiver more and the window of rest begins anew (0.08 s later)."""

PERTURBED_RELATIVE = 1e-4
"""A law that jumps at half turns, asked there with noise, chooses its side by the last bit; what settles all the same
has been driven on by its goal or its noise for five thousand steps."""


def compliance(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Hands in contact: outcomes where no rounding decides them, numbers of what is done in both."""
    table = table_of("compliance")
    old, new, found = aligned(table, old, new)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    torque = np.fmin(new["peak_torque_ratio"].to_numpy(), old["peak_torque_ratio"].to_numpy())
    decided = ~_on_singular_set(old) & ~(torque > THROWN)
    found += changed(table, "outcome", old, new, ~same & decided)
    both = same & decided & (old["outcome"].astype(str) == "done")
    found += changed(table, "rest", old, new, both & (old["rest"].astype(str) != new["rest"].astype(str)))
    return found + compared(table, old, new, _as_near_as_contact_leaves(old), both, ["outcome", "rest"])


def _as_near_as_contact_leaves(rows: pd.DataFrame) -> Close:
    """By row, and where it ends by column."""
    is_peg = (rows["task"].astype(str) == PEG) & ~rows["form"].astype(str).isin(CANCELLING)
    creeps = rows["rest"].astype(str) == CREEPING
    relative = np.select([creeps, is_peg], [CREEP_RELATIVE, PEG_RELATIVE], CONTACT_RELATIVE)
    absolute = np.select([creeps, is_peg], [CREEP_ABSOLUTE, PEG_ABSOLUTE], CONTACT_ABSOLUTE)
    return lambda column, a, b: near(*ENDS.get(column, (relative, absolute)))(column, a, b)


def robustness(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Laws under perturbations: outcomes exactly, numbers of what settled in both."""
    table = table_of("robustness")
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
