"""Which law to use where the robot takes torques and no inertia is cancelled: tau = K e - D omega, as arms are shipped.

By the same rule, from the laws that the experiment `shipped` ran at the gains of controllers that cancel no inertia: a
value for each controller and angle of start. What those rows have no number for (effort, peak, variation, noise at
180 degrees) ties.
"""

from __future__ import annotations

import functools
import math
from pathlib import Path

import numpy as np

from bench.errors import BadResults
from bench.experiments.shipped import SETTLING_DEG
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.criteria import BY_NAME, CRITERIA
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import EVERYWHERE, Decision, Need, decide
from bench.findings.selection.tables import tables_of
from bench.law.shipped import TORQUE

UNCANCELLED = Need("your robot takes torques and you cancel no inertia", (EVERYWHERE,))
OF_THE_LAW = ("tick", "memory", "jump")
"""Criteria that are the law's own, whatever it commands."""
FULL_TURN = 2.0
"""Way over the shortest, at the least, of a start at 120 degrees or less that goes the long way."""


def measure(results: Results) -> Measured:
    """The criteria of every law that was run at the gains of controllers that cancel no inertia.

    Errors:
        NoEvidence: the run has no such row.
    """
    tables = tables_of(results)
    try:
        rows = results.table("shipped", level=TORQUE, shapes_inertia="no")
    except BadResults as error:  # a run that is older than the table
        raise NoEvidence("no shipped controller was run (try: python -m bench run --experiment shipped)") from error
    rows = rows[rows["law"].astype(str).isin(tables.contenders)].sort_values("shipped", kind="stable")
    if rows.empty:
        raise NoEvidence("no law was run at a shipped controller's gains")
    known = {str(name): own for name, own in rows.groupby("law", observed=True)}
    tables = tables._replace(contenders={name: one for name, one in tables.contenders.items() if name in known})
    values = {name: BY_NAME[name].measure(tables) for name in OF_THE_LAW}
    columns = [f"settling_{angle}_s" for angle in SETTLING_DEG]
    times = {law: own[columns].fillna(math.inf).to_numpy(dtype=float).ravel() for law, own in known.items()}
    values["time"] = values["worst"] = times
    values["unsettled"] = {law: (100.0 * own["lost"] / own["starts"]).to_numpy() for law, own in known.items()}
    values["lost"] = {law: np.array([float(own["dead"].sum())]) for law, own in known.items()}
    values["detour"] = {law: np.array([FULL_TURN if own["away"].any() else 1.0]) for law, own in known.items()}
    return Measured(tables, {one.name: {} for one in CRITERIA} | values)


@functools.cache
def uncancelled_choice(folder: Path) -> Decision:
    """What is advised there by the run in a folder; NoEvidence if it has no such rows."""
    return decide(UNCANCELLED, measure(Results(folder)))
