"""Controllers as they are shipped: stiffness and damping felt, dead points, unwinding, settling; beside our laws."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.contenders.registry import known_regulators, known_shipped
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.experiments.suites import BEST, LONG
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "shipped"

LAWS = tuple(word.partition("@")[0] for word in BEST)
"""What is compared with them, whatever is advised: that is among these."""

CONTROLLER_S = 0.7
"""CPU seconds a controller, most of them for the audit and for compiling."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """Return a unit for each controller."""
    return tuple(Unit(NAME, selector=name, count=1, total=1, horizon_s=LONG) for name in known_shipped())


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The controller, then each of LAWS at its gains."""
    from bench.experiments.rows.shipped import frame

    laws = tuple(law for law in LAWS if law.partition("/")[0] in known_regulators())
    return frame(known_shipped()[unit.selector], laws, settings, unit.horizon_s)


EXPERIMENT = Experiment(
    NAME,
    "controllers as they are shipped",
    TABLES[NAME],
    units,
    rows,
    cost_s=lambda unit: CONTROLLER_S,
    compiles=False,
)
