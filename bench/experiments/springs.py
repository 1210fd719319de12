"""Rotational springs with a stiffness matrix: which are springs at all, by their work over closed ways."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.contenders.registry import known_springs
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "springs"


def units(asked: Asked) -> tuple[Unit, ...]:
    """Return one unit."""
    return (Unit(NAME, count=len(known_springs()), total=len(known_springs()), horizon_s=2.0),)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """A row a spring and frame."""
    from bench.experiments.rows.springs import frame

    return frame(settings.seed)


EXPERIMENT = Experiment(
    NAME,
    "rotational springs with a stiffness matrix",
    TABLES[NAME],
    units,
    rows,
    cost_s=lambda unit: 1.0,
    compiles=False,
)
