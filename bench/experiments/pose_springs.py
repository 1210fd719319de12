"""Springs of position and orientation: which are springs, and which ways they make a hand go."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.contenders.registry import known_pose_springs
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "pose-springs"


def units(asked: Asked) -> tuple[Unit, ...]:
    """Return one unit."""
    return (Unit(NAME, count=len(known_pose_springs()), total=len(known_pose_springs()), horizon_s=2.0),)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """A row a spring."""
    from bench.experiments.rows.pose_springs import frame

    return frame(settings.seed)


EXPERIMENT = Experiment(
    NAME,
    "springs of position and orientation",
    TABLES[NAME],
    units,
    rows,
    cost_s=lambda unit: 3.0,
    compiles=False,
)
