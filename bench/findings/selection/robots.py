"""The robots that the map does not cover, and the laws that the map's rule advises for each, by the rows of a run.

One rule decides (`regions`); a robot says which of its requirements its rows can answer, and which number decides.
"""

import functools
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.base.errors import NoEvidence
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings.selection.nearest import answer
from bench.findings.selection.regions import Rule, RuleVerdict, decide, find_default
from bench.findings.selection.run_rows import (
    Compared,
    compare_arms,
    compare_positions,
    compare_velocities,
)
from bench.findings.subjects import SentenceSubject
from tasks.situation import UNCANCELLED

OF_ARMS = Rule(adversary=False, by="missed")
"""A goal that is never exactly 180° away leaves no place for noise at 180°."""

OF_FIRST_ORDER = Rule(adversary=False, overshoot=float("inf"))
"""First-order laws were run without noise, and their overshoot was not measured."""

MEASURES: dict[str, tuple[Rule, Callable[[Run], Compared]]] = {
    "arm": (OF_ARMS, compare_arms),
    "velocity": (OF_FIRST_ORDER, compare_velocities),
    "position": (OF_FIRST_ORDER, compare_positions),
}
"""The rule of each robot, and what compares laws on its rows."""


class Robot(NamedTuple):
    """A kind of robot: what it takes, what was run, its subject, the rule, and what compares laws on its rows."""

    takes: str
    rows: str
    subject: SentenceSubject
    rule: Rule
    compare: Callable[[Run], Compared]


ROBOTS = {
    name: Robot(texts["takes"], texts["rows"], SentenceSubject(texts["subject"]), *MEASURES[name])
    for name, texts in tomllib.loads(
        Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    ).items()
}
"""The robots of robots.toml by name."""
ARM, VELOCITY, POSITION = ROBOTS.values()

RUN = RESULTS / "reference"
"""The run by which robots beside those of the map are advised: for the terminal, the front page and every table.

A run of one's own has other starts, and so other ties: read of it, the terminal and the book gave different laws.
"""


@functools.cache
def compare_for(robot: Robot, folder: Path) -> Compared:
    """Return the laws compared on the rows of a robot in the run of a folder; NoEvidence if it has none."""
    return robot.compare(Run(folder))


def decide_for(robot: Robot, folder: Path = RUN) -> RuleVerdict | None:
    """Return what is advised for a robot by the run in a folder; None where the run has no such rows."""
    try:
        compared = compare_for(robot, folder)
    except NoEvidence:
        return None
    return decide(compared.rows, robot.rule, compared.pairs)


class Elsewhere(NamedTuple):
    """What leads to a law: the words after "if", the law, those that tie with it, how many meet the requirements."""

    words: str
    law: str
    tied: tuple[str, ...] = ()
    compared: int = 0


def list_elsewhere() -> list[Elsewhere]:
    """Return the law for robots and controllers that are not those of the default, by the map and by RUN."""
    uneven = answer(UNCANCELLED).verdict
    stores, jumps = Rule(forgetful=True), Rule(continuous=True)
    found = [
        Elsewhere(
            "you command torques, and cancel no inertia",
            uneven.law or "none",
            uneven.tied,
            uneven.eligible,
        ),
        Elsewhere(
            "your controller stores nothing between control periods", find_default(rule=stores)
        ),
        Elsewhere("the command must be continuous", find_default(rule=jumps)),
    ]
    for robot in ROBOTS.values():
        verdict = decide_for(robot)
        if verdict and verdict.law:
            words = f"your robot takes {robot.takes}"
            found.append(Elsewhere(words, verdict.law, verdict.tied, verdict.eligible))
    return found
