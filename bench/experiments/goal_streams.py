"""Goals that arrive as a stream (tasks/goal_stream.py): what each way to fill them in makes of each law."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.contenders.registry import known_regulators
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.experiments.suites import STREAMED
from bench.tables.schema import TABLES
from tasks.goal_stream import LENGTH_S, STREAMS

if TYPE_CHECKING:
    import pandas as pd

NAME = "goal-streams"


def units(asked: Asked) -> tuple[Unit, ...]:
    """Return one unit."""
    return (Unit(NAME, count=len(STREAMS), total=len(STREAMS), horizon_s=LENGTH_S),)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """A row a stream and law."""
    from bench.experiments.rows.goal_streams import frame

    return frame(settings, [law for law in STREAMED if law in known_regulators()])


EXPERIMENT = Experiment(
    NAME, "goals that arrive as a stream", TABLES[NAME], units, rows, cost_s=lambda unit: 1.0, compiles=False
)
