"""How far K dt may be raised: the largest at which errors near the goal die out, and at which none grows far from it.

By bisection, on the free body for every law, and on arms for one law by every inverse and behind servos with a lag.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import tasks
from bench.experiments import arm, velocity
from bench.experiments.experiment import OF_LAWS, Asked, Experiment, Settings, Unit, own_last
from bench.experiments.suites import BY_EVERY_INVERSE
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "velocity-limits"

LAW_S, ARM_S = 0.01, 0.4
"""CPU seconds a law on the free body, and an inverse on an arm."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit a law on the free body; on each arm one for each inverse of one law."""
    some = velocity.velocity_laws(asked)
    made = [Unit(NAME, one.name, "free-body") for one in some]
    for name in dict.fromkeys(unit.arm for unit in arm.units(asked)):
        made += [
            Unit(NAME, one.name, "arm-regulation", name)
            for law in some
            if law.name == BY_EVERY_INVERSE
            for one in velocity.on_joints(law, tasks.arm(name).joints)
        ]
    return own_last(made, asked.own)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a reach and lag."""
    from bench.experiments.rows.velocity_limits import frame

    return frame(settings, unit)


EXPERIMENT = Experiment(
    NAME,
    "the largest K dt of first-order laws",
    TABLES[NAME],
    units,
    rows,
    takes=(*OF_LAWS, "arms"),
    cost_s=lambda unit: ARM_S if unit.arm else LAW_S,
    prepare=velocity.prepare,
    ticks=lambda settings, unit: 1e6,
)
