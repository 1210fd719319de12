"""What a robot takes, and the laws that the rule advises for it: each by rows of robots that take just that."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.measured import Measured
from bench.findings.selection.measured import measure as measure_all
from bench.findings.selection.needs import (
    ARM,
    DEFAULT,
    EVERYWHERE,
    FORGETFUL,
    NEARLY,
    NEEDS,
    SMOOTH,
    Advice,
    Decision,
    Need,
    advice,
)
from bench.findings.selection.robot_rows import measure_uncancelled, measure_velocities


class Robot(NamedTuple):
    """A kind of robot; the defaults are those of robots that take torques, with the inertia cancelled.

    takes: the command. rows: what was run. page: its file in the book. need: its situation. measure: how laws are
    measured on it. usual: the default requirements. needs: the other situations.
    """

    takes: str
    rows: str
    page: str
    need: Need
    measure: Callable[[Results], Measured] = measure_all
    usual: Need = DEFAULT
    needs: tuple[Need, ...] = NEEDS


VELOCITY = Need("your robot takes velocities", (EVERYWHERE,))
UNCANCELLED = Need("your robot takes torques and you cancel no inertia", (EVERYWHERE,))
POSITION = Need("your robot takes positions", (EVERYWHERE,), ("late",))
"""A position loop of time constant T that is given the integral of omega moves as a servo of velocity with lag T does:
(q_d - q)/T is omega through 1/(T s + 1)."""

VELOCITIES = Robot(
    "velocities",
    "first-order laws on the free body",
    "17-velocity-commands",
    VELOCITY,
    measure_velocities,
    VELOCITY,
    (
        Need("the fastest, at equal gain near the goal", (EVERYWHERE,), ("time",)),
        Need("the smallest peak of the command", (EVERYWHERE,), ("peak",)),
        Need("no memory in the controller", (EVERYWHERE, FORGETFUL)),
        Need("a continuous command", (NEARLY, FORGETFUL, SMOOTH)),
        Need("an arm commanded by joint rates from the standard inverse", (EVERYWHERE,), ("arms",)),
    ),
)

ROBOTS = (
    Robot(
        "torques, and a model cancels the inertia",
        "every law: the free body, every perturbation",
        "15-comparison",
        DEFAULT,
    ),
    Robot("the same, on an arm where exact 180° rotations do not come", "every law, four arms", "08-arms", ARM),
    Robot(
        "torques, no inertia cancelled",
        "laws at the gains of shipped controllers",
        "17-velocity-commands",
        UNCANCELLED,
        measure_uncancelled,
        UNCANCELLED,
        (),
    ),
    VELOCITIES,
    Robot(
        "positions, by a loop of its own that lags",
        "first-order laws on four arms with lagging servos",
        "17-velocity-commands",
        POSITION,
        measure_velocities,
        POSITION,
        (),
    ),
)


def advise_for(robot: Robot, folder: Path) -> Advice:
    """Return what is advised in every situation of a robot by the run in a folder.

    Errors:
        NoEvidence: the run has no rows of such robots.
    """
    return advice(folder, robot.measure, robot.usual, robot.needs)


def word_of(robot: Robot, folder: Path) -> Decision | None:
    """What is advised for a robot by the run in a folder; None where the run has no such rows."""
    try:
        return advise_for(robot, folder).of(robot.need)
    except NoEvidence:
        return None
