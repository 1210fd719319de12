"""What a robot takes, and the law that the rule advises for it: each by rows of robots that take just that."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.needs import ARM, DEFAULT, Decision, advice
from bench.findings.selection.uncancelled import uncancelled_choice
from bench.findings.selection.velocity import position_choice, velocity_choice


class Robot(NamedTuple):
    """takes: the command; rows: what was run; page: its file in the book; decide(folder) -> the rule's word."""

    takes: str
    rows: str
    page: str
    decide: Callable[[Path], Decision]


ROBOTS = (
    Robot(
        "torques, and a model cancels the inertia",
        "every law: the free body, every perturbation",
        "15-comparison",
        lambda folder: advice(folder).of(DEFAULT),
    ),
    Robot(
        "the same, on an arm where exact 180° rotations do not come",
        "every law, four arms",
        "08-arms",
        lambda folder: advice(folder).of(ARM),
    ),
    Robot(
        "torques, no inertia cancelled",
        "laws at the gains of shipped controllers",
        "18-as-shipped",
        uncancelled_choice,
    ),
    Robot(
        "velocities",
        "first-order laws on the free body",
        "17-velocity-commands",
        lambda folder: velocity_choice(folder).default,
    ),
    Robot(
        "positions, by a loop of its own that lags",
        "first-order laws on four arms with lagging servos",
        "17-velocity-commands",
        position_choice,
    ),
)


def word_of(robot: Robot, folder: Path) -> Decision | None:
    """What is advised for a robot by the run in a folder; None where the run has no such rows."""
    try:
        return robot.decide(folder)
    except NoEvidence:
        return None
