"""Laws with a state of their own under a constant disturbance, and beside them the paper's law with the same spring."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.contenders.registry import known_compensators
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "compensators"

DISTURBANCES = (0.0, 5.0, 20.0)
"""Lengths [rad/s^2]; over the paper's Kp they are the sine of what a law without an integral leaves: 2.9 and 11.5
degrees."""
STARTS = 64
HORIZON_S = 8.0
"""[s]. The slowest of the starts, 2 degrees short of 180, is settled by half of it."""
LEVEL_S = 0.12
"""CPU seconds a level."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """Return a unit for each law."""
    each = asked.count or STARTS
    return tuple(
        Unit(NAME, selector=name, count=each, total=each, horizon_s=asked.horizon_s or HORIZON_S)
        for name in ("", *known_compensators())
    )


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """A row a level."""
    from bench.experiments.rows.compensators import frame

    return frame(settings, unit, DISTURBANCES)


def prepare(settings: Settings, unit: Unit) -> None:
    """Compile the loop and the law."""
    from bench.engines.compensated import prepare as compiled
    from bench.experiments.rows.compensators import law_of

    compiled(law_of(unit.selector))


EXPERIMENT = Experiment(
    NAME,
    "laws with a state of their own",
    TABLES[NAME],
    units,
    rows,
    cost_s=lambda unit: LEVEL_S * len(DISTURBANCES),
    compiles=False,
    prepare=prepare,
)
