"""The rows of a run that laws are compared on: the free body, the same starts for every law, and the time of a law.

A law's time is a share of a whole controller's (tests/benchmarks/test_arms.py) with the rotation-matrix law, by the
times of results/timings.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from bench.base.errors import NoEvidence
from bench.base.on_first_use import pd
from bench.experiments.tables.run import (
    FREE_BODY,
    MAIN_ENGINE,
    Run,
    require_rows,
    with_contender,
)
from bench.findings.claims.adequacy import tallied
from bench.findings.claims.tables import settled
from bench.findings.start_sets import DIRECTED
from bench.law.contender import Contender
from bench.law.contenders.registry import all_contenders, contenders_of

SAMPLED = "native"
"""The engine of a law that cannot run on the continuous plant: MuJoCo's own actuator."""


class ComparedRows(NamedTuple):
    """Hold the rows of a run that laws are compared on.

    Attributes:
        uniform: Uniform starts of the free body that every law ran.
        directed: Directed starts that every law ran.
        costs: Law -> its rows of costs.
        robustness: Perturbed episodes.
        arms: Episodes on arms as they are, by the geometric Jacobian.
        ticks: Law -> its time over a whole controller's tick [%], of the laws that were timed.
        contenders: The laws compared, by name, the simplest first.
    """

    uniform: pd.DataFrame
    directed: pd.DataFrame
    costs: dict[str, pd.DataFrame]
    robustness: pd.DataFrame
    arms: pd.DataFrame
    ticks: dict[str, float]
    contenders: dict[str, Contender]

    def spent(self, name: str, branch: str = "typical") -> tuple[int, int]:
        """Return flops and calls a tick, the goal given as a rotation matrix."""
        rows = self.costs[name]
        return tallied(rows[rows["branch"] == branch], with_goal=True)

    def memory(self, name: str) -> int:
        """Return how many numbers a law keeps from tick to tick."""
        return len(self.contenders[name].regulator.memory or ())

    def simplicity(self, name: str) -> tuple[int, int]:
        """Return numbers kept, and operations of a typical tick, a call counted as one: less is simpler."""
        return self.memory(name), sum(self.spent(name))


def select_rows(run: Run) -> ComparedRows:
    """Return the rows of a run for every law that has uniform starts, half-turn starts and a cost."""
    every = run.table("episodes")
    runs = every[(every["task"] == "free-body") & every["engine"].isin((MAIN_ENGINE, SAMPLED))]
    on_main = set(runs.loc[runs["engine"] == MAIN_ENGINE, "contender"])
    runs = runs[(runs["engine"] == MAIN_ENGINE) | ~runs["contender"].isin(on_main)]
    costs = run.table("costs", **FREE_BODY)
    priced = {str(name): rows for name, rows in costs.groupby("contender", observed=True)}
    sets = runs.groupby("contender", observed=True)["start_set"].agg(set)
    laws = run.user_laws()
    # a user's law that may not run cannot be asked how far it jumps, and is left out
    own = [one for law in laws if law.text for one in contenders_of(law)]
    known = {one.name: one for one in (*all_contenders(), *own)}
    names = [name for name in sets.index if {"uniform", "half-turn"} <= sets[name] and name in priced and name in known]
    runs = require_rows(runs[runs["contender"].isin(names)], "law with uniform and half-turn starts and a cost")
    runs = runs.assign(contender=runs["contender"].astype(str), lost=~settled(runs))
    named = {name: known[name] for name in names}
    robustness = require_rows(run.table("robustness"), "perturbed law")
    found = ComparedRows(
        common(runs[runs["start_set"] == "uniform"]),
        common(runs[runs["start_set"].isin(DIRECTED)]),
        priced,
        robustness.assign(contender=robustness["contender"].astype(str), lost=~settled(robustness)),
        _on_arms(every),
        ticks(run),
        named,
    )
    order = sorted(named, key=lambda name: (*found.simplicity(name), name))
    return found._replace(contenders={name: named[name] for name in order})


def common(runs: pd.DataFrame) -> pd.DataFrame:
    """Rows of the starts that every law ran, in the order of the starts."""
    ran = runs.groupby(["start_set", "start_id"], observed=True)["contender"].transform("nunique")
    kept = runs[ran == runs["contender"].nunique()]
    return kept.sort_values(["start_set", "start_id"], kind="stable").reset_index(drop=True)


def by_law(rows: pd.DataFrame, column: str, failed: float | None = None) -> dict[str, np.ndarray]:
    """Return a column by law in the order of starts; `failed` where none settles. NoEvidence: no such column."""
    if column not in rows:
        raise NoEvidence(f"the run is older than the column {column}, and says nothing of it")
    values = rows[column].astype(float) if failed is None else rows[column].where(~rows["lost"], failed)
    return {str(name): own.to_numpy() for name, own in values.groupby(rows["contender"], observed=True)}


def _on_arms(every: pd.DataFrame) -> pd.DataFrame:
    """Uniform starts on arms as they are, with all gains that were run; `contender` is the law alone."""
    is_wanted = (every["task"] == "arm-regulation") & (every["start_set"] == "uniform")
    is_wanted &= (every["jacobian"] == "geometric") & (every["variation"] == "nominal") & (every["engine"] == SAMPLED)
    rows = every[is_wanted].sort_values("kp", kind="stable")
    law = rows["contender"].astype(str).str.split("@").str[0]
    return by_standard_inverse(rows.assign(contender=law, lost=~settled(rows)))


def by_standard_inverse(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of arms by their standard inverse, in the order of arms and starts."""
    own = rows[(rows["arm"] != "") & rows["inverse"].isin(("solve", "pseudo-inverse"))]
    own = own.assign(inverse=own["inverse"].astype(str))
    solves = own["inverse"] == "solve"
    has_solve = solves.groupby([own["contender"], own["arm"]], observed=True).transform("any")
    return own[~has_solve | solves].sort_values(["arm", "start_set", "start_id"], kind="stable")


BY = "rotation-matrix@geometric"
"""The controller of the denominator, by the inverse of each arm."""


def ticks(run: Run) -> dict[str, float]:
    """Return law -> its time alone over a whole controller's [%], the medians over arms and those machines."""
    found: dict[str, list[float]] = {}
    timed = [times for times in run.machines() if "arm" in times]
    for frame in map(with_contender, timed):
        is_whole = (frame["what"] == "controller") & frame["contender"].astype(str).str.startswith(BY)
        whole = frame.loc[is_whole & (frame["ticks"] > 0), "ratio"].median()
        alone = frame[(frame["what"] == "law") & (frame["ticks"] > 0)]
        for law, ratio in zip(alone["contender"].astype(str), alone["ratio"], strict=True):
            found.setdefault(law, []).append(100.0 * float(ratio / whole))
    return {law: float(np.median(shares)) for law, shares in found.items() if np.isfinite(shares).all()}
