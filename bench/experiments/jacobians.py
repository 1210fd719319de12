"""Jacobians over poses of every arm that is run: a unit an arm; what is looked at is said in `poses`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import tasks
from bench.experiments import arm
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

ARM_S, POSE_S = 5.0, 5e-3
"""CPU seconds of an arm's directed poses, and of each random one."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit for each arm that episodes are run on; `count` random poses."""
    count = asked.suite.on_arms.poses
    arms = dict.fromkeys(unit.arm for unit in arm.units(asked) if count)
    return tuple(of_arm(name, count) for name in arms)


def of_arm(name: str, count: int) -> Unit:
    """The unit of an arm, with so many random poses."""
    return Unit("jacobians", arm=name, count=count, total=count)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a pose and representation."""
    from bench.experiments.rows.poses import frame

    return frame(tasks.arm(unit.arm), unit.count, settings.seed)


EXPERIMENT = Experiment(
    "jacobians",
    "Jacobians over an arm's poses",
    TABLES["poses"],
    units,
    rows,
    takes=("tasks", "arms"),
    cost_s=lambda unit: ARM_S + POSE_S * unit.count,
    compiles=False,
)
