"""Which law to use where the robot takes velocities: by the same rule, from the rows of first-order laws.

A law that is no velocity law was not asked. Criteria keep their names and what is notable; peak is that of omega
[rad/s]. What a first-order loop has no number for (effort, variation, noise at 180°) ties.
"""

from __future__ import annotations

import functools
import math
from pathlib import Path

import numpy as np
import pandas as pd

from bench.errors import BadResults
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.criteria import BY_NAME, CRITERIA
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import EVERYWHERE, FORGETFUL, NEARLY, SMOOTH, Advice, Decision, Need, advise, decide
from bench.findings.selection.tables import by_law, common, tables_of

VELOCITY = Need("your robot takes velocities", (EVERYWHERE,))
"""What a velocity law must have to be advised where nothing else is said."""

NEEDS = (
    Need("the fastest, at equal gain near the goal", (EVERYWHERE,), ("time",)),
    Need("the smallest peak of the command", (EVERYWHERE,), ("peak",)),
    Need("no memory in the controller", (EVERYWHERE, FORGETFUL)),
    Need("a continuous command", (NEARLY, FORGETFUL, SMOOTH)),
    Need("an arm commanded by joint rates from the standard inverse", (EVERYWHERE,), ("arms",)),
)
"""Situations of a robot that takes velocities."""

POSITION = Need("your robot takes positions", (EVERYWHERE,), ("late",))
"""A position loop of time constant T that is given the integral of omega moves as a servo of velocity with lag T does:
(q_d - q)/T is omega through 1/(T s + 1)."""


def measure(results: Results) -> Measured:
    """The criteria of every first-order law of a run at the full share of K, without a limiter.

    Errors:
        NoEvidence: the run commands no robot by velocities.
    """
    rows = _commanded(results)
    law = rows["contender"].astype(str).str.partition("@")[0]
    rows = rows.assign(contender=law, lost=rows["outcome"].astype(str) != "settled")
    tables = tables_of(results)
    rows = rows[rows["contender"].isin(tables.contenders)]
    free = rows[rows["arm"] == ""]
    uniform, exact = (common(free[free["start_set"] == name]) for name in ("uniform", "half-turn"))
    known = set(uniform["contender"])
    contenders = {name: one for name, one in tables.contenders.items() if name in known}
    tables = tables._replace(uniform=uniform, directed=exact, contenders=contenders, robustness=pd.DataFrame())
    values = {one.name: BY_NAME[one.name].measure(tables) for one in CRITERIA if one.name in AS_EVER}
    ways = [by_law(part, "path_ratio") for part in (uniform, exact)]
    values["detour"] = {name: np.array([np.nanmax([*(way[name].max() for way in ways)])]) for name in contenders}
    values["peak"] = by_law(uniform, "peak_omega", math.inf)
    at_once, late = (_on_arms(rows[is_late]) for is_late in (rows["lag_s"] == 0.0, rows["lag_s"] > 0.0))
    at_once = at_once[at_once["start_set"] == "uniform"]
    values["arms"] = by_law(at_once.assign(passed=100.0 * ~at_once["lost"]), "passed")
    values["late"] = by_law(late, "settling_time_s", math.inf)
    return Measured(tables, {one.name: {} for one in CRITERIA} | values)


def _commanded(results: Results) -> pd.DataFrame:
    """Rows at the full share of K without a limiter; there is at least one."""
    advice = "no robot was commanded by velocities (try: python -m bench run --experiment velocity)"
    try:
        rows = results.table("velocity", limiter="none")
    except BadResults as error:  # a run that is older than the table
        raise NoEvidence(advice) from error
    if not len(rows) or not (rows["share"] == 1.0).any():
        raise NoEvidence(advice)
    return rows[rows["share"] == 1.0]


AS_EVER = ("unsettled", "lost", "time", "worst", "spread", "tick", "memory", "jump")
"""Criteria that are measured of these rows as of any others."""


def _on_arms(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of arms by their standard inverse, in the order of arms and starts."""
    own = rows[(rows["arm"] != "") & rows["inverse"].isin(("solve", "pseudo-inverse"))]
    has_solve = own.groupby(["contender", "arm"], observed=True)["inverse"].transform(
        lambda one: (one == "solve").any()
    )
    return own[~has_solve | (own["inverse"] == "solve")].sort_values(["arm", "start_set", "start_id"], kind="stable")


@functools.cache
def velocity_measured(folder: Path) -> Measured:
    """The criteria of the run in a folder."""
    return measure(Results(folder))


@functools.cache
def velocity_choice(folder: Path) -> Advice:
    """What is advised where a robot takes velocities, by the run in a folder; NoEvidence if it has no such rows."""
    return advise(velocity_measured(folder), VELOCITY, NEEDS)


@functools.cache
def position_choice(folder: Path) -> Decision:
    """What is advised where a robot takes positions, by the rows of arms whose servos lag; errors as above."""
    return decide(POSITION, velocity_measured(folder))
