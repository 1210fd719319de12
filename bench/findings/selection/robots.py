"""What a robot takes, and the laws that the rule advises for it: each by rows of robots that take just that."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection import needs
from bench.findings.selection.measured import Measured, measure
from bench.findings.selection.needs import ARM, DEFAULT, EVERYWHERE, FORGETFUL, NEARLY, SMOOTH, Advice, Decision, Need
from bench.findings.selection.robot_rows import measure_uncancelled, measure_velocities


class Robot(NamedTuple):
    """A kind of robot.

    takes: the command. rows: what was run. page: its file in the book. measure: how laws are measured on it. usual:
    what is asked where nothing else is known; needs: the other situations; need: the one that is this robot's.
    """

    takes: str
    rows: str
    page: str
    measure: Callable[[Results], Measured]
    need: Need
    usual: Need
    needs: tuple[Need, ...] = ()


VELOCITY = Need("your robot takes velocities", (EVERYWHERE,))
UNCANCELLED = Need("your robot takes torques and you cancel no inertia", (EVERYWHERE,))
POSITION = Need("your robot takes positions", (EVERYWHERE,), ("late",))
"""A position loop of time constant T that is given the integral of omega moves as a servo of velocity with lag T does:
(q_d - q)/T is omega through 1/(T s + 1)."""

VELOCITIES = Robot(
    "velocities",
    "first-order laws on the free body",
    "17-velocity-commands",
    measure_velocities,
    VELOCITY,
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
        measure,
        DEFAULT,
        DEFAULT,
        needs.NEEDS,
    ),
    Robot(
        "the same, on an arm where exact 180° rotations do not come",
        "every law, four arms",
        "08-arms",
        measure,
        ARM,
        DEFAULT,
        needs.NEEDS,
    ),
    Robot(
        "torques, no inertia cancelled",
        "laws at the gains of shipped controllers",
        "17-velocity-commands",
        measure_uncancelled,
        UNCANCELLED,
        UNCANCELLED,
    ),
    VELOCITIES,
    Robot(
        "positions, by a loop of its own that lags",
        "first-order laws on four arms with lagging servos",
        "17-velocity-commands",
        measure_velocities,
        POSITION,
        POSITION,
    ),
)


def advise_for(robot: Robot, folder: Path) -> Advice:
    """Return what is advised in every situation of a robot by the run in a folder.

    Errors:
        NoEvidence: the run has no rows of such robots.
    """
    return needs.advice(folder, robot.measure, robot.usual, robot.needs)


def word_of(robot: Robot, folder: Path) -> Decision | None:
    """What is advised for a robot by the run in a folder; None where the run has no such rows."""
    try:
        return advise_for(robot, folder).of(robot.need)
    except NoEvidence:
        return None
