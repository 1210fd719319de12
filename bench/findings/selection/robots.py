"""What a robot takes, and the laws that the rule advises for it: each by rows of robots that take just that.

By a criterion that such rows have no number for, laws tie.
"""

import math
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from bench.base.errors import BadResults
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.criteria import CRITERIA
from bench.findings.selection.nearest import answer
from bench.findings.selection.needs import FACTS, Decision, Measured, Need, decide, measure, measured
from bench.findings.selection.regions import Rule, find_default
from bench.findings.selection.tables import by_law, by_standard_inverse, common, tables_of
from bench.findings.subjects import SentenceSubject
from tasks.situation import UNCANCELLED


def measure_velocities(results: Results) -> Measured:
    """Return the criteria of every first-order law at the full share of K, without a limiter; peak is of omega."""
    advice = "no robot was commanded by velocities (try: bench run --experiment velocity)"
    try:
        rows = results.table("velocity", limiter="none")
    except BadResults as error:  # a run that is older than the table
        raise NoEvidence(advice) from error
    rows = rows[rows["share"] == 1.0] if len(rows) else rows
    if rows.empty:
        raise NoEvidence(advice)
    law = rows["contender"].astype(str).str.partition("@")[0]
    rows = rows.assign(contender=law, lost=rows["outcome"].astype(str) != "settled")
    tables = tables_of(results)
    rows = rows[rows["contender"].isin(tables.contenders)]
    free = rows[rows["arm"] == ""]
    uniform, exact = (common(free[free["start_set"] == name]) for name in ("uniform", "half-turn"))
    known = {name: one for name, one in tables.contenders.items() if name in set(uniform["contender"])}
    tables = tables._replace(contenders=known, uniform=uniform, directed=exact, robustness=pd.DataFrame())
    at_once, late = (by_standard_inverse(rows[is_late]) for is_late in (rows["lag_s"] == 0.0, rows["lag_s"] > 0.0))
    at_once = at_once[at_once["start_set"] == "uniform"]
    as_ever = ("unsettled", "lost", "detour", "time", "worst", "tick", "memory")
    values = {one.name: one.measure(tables) if one.name in as_ever else {} for one in CRITERIA}
    return Measured(
        tables,
        values
        | {
            "peak": by_law(uniform, "peak_omega", math.inf),
            "arms": by_law(at_once.assign(passed=100.0 * ~at_once["lost"]), "passed"),
            "late": by_law(late, "settling_time_s", math.inf),
        },
    )


class Robot(NamedTuple):
    """A kind of robot: what it takes, the rows that were run, its subject, and how laws are measured on it."""

    takes: str
    rows: str
    subject: SentenceSubject
    need: Need
    measure: Callable[[Results], Measured]


ROBOTS = {
    name: Robot(
        said["takes"],
        said["rows"],
        SentenceSubject(said["subject"]),
        Need(tuple(FACTS[word] for word in said["facts"]), tuple(said.get("by", ()))),
        measure if name == "arm" else measure_velocities,
    )
    for name, said in tomllib.loads(Path(__file__).with_name("robots.toml").read_text(encoding="utf-8")).items()
}
"""The robots of robots.toml by name."""
ARM, VELOCITY, POSITION = ROBOTS.values()


RUN = RESULTS / "reference"
"""The run by which robots beside those of the map are advised: for the terminal, the front page and every table.

A run of one's own has other starts, and so other ties: read of it, the terminal and the book gave different laws.
"""


def decide_for(robot: Robot, folder: Path = RUN) -> Decision | None:
    """Return what is advised for a robot by the run in a folder; None where the run has no such rows."""
    try:
        return decide(robot.need, measured(folder, robot.measure))
    except NoEvidence:
        return None


class Elsewhere(NamedTuple):
    """What leads to a law: the words after "if", the law, those that tie with it, how many were compared."""

    words: str
    law: str
    tied: tuple[str, ...] = ()
    compared: int = 0


def list_elsewhere() -> list[Elsewhere]:
    """Return the law for robots and controllers that are not those of the default, by the map and by RUN."""
    uneven = answer(UNCANCELLED).verdict
    found = [
        Elsewhere("you command torques, and cancel no inertia", uneven.law or "none", uneven.tied, uneven.asked),
        Elsewhere("your controller stores nothing between control periods", find_default(rule=Rule(forgetful=True))),
        Elsewhere("the command must be continuous", find_default(rule=Rule(continuous=True))),
    ]
    for robot in ROBOTS.values():
        decision = decide_for(robot)
        if decision and decision.law:
            words = f"your robot takes {robot.takes}"
            found.append(Elsewhere(words, decision.law, decision.tied, len(decision.asked)))
    return found
