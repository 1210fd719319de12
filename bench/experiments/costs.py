"""Operations a tick: of every law of ours, run or not, unless something is named; and of every controller on an arm."""

from __future__ import annotations

from typing import TYPE_CHECKING

import tasks
from bench.contenders.registry import all_contenders
from bench.errors import BadLaw
from bench.experiments import arm, free_body
from bench.experiments.experiment import EVERYTHING, Asked, Experiment, Settings, Unit, own_last
from bench.experiments.traces import laws
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

LAW_S, CONTROLLER_S = 0.2, 1.0
"""CPU seconds of counting; none where it has been counted before."""

BEYOND = "reference"
"""The engine of a unit whose law may be beyond what can be counted, for this engine alone runs it."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit a law, then one for each controller and number of joints that it is run with; a user's last."""
    on_arms: dict = {}
    for unit in arm.units(asked):
        on_arms.setdefault((unit.contender, tasks.arm(unit.arm).joints), unit.arm)
    ours = () if asked.choice.named else all_contenders()
    names = dict.fromkeys(one.name for one in (*ours, *laws(asked)))
    places = [*((name, "") for name in names), *((name, on) for (name, _), on in on_arms.items())]
    is_beyond = all(unit.engine == BEYOND for unit in (*free_body.units(asked), *arm.units(asked)))
    engine = BEYOND if is_beyond else ""
    return own_last([Unit("costs", name, arm=on, engine=engine) for name, on in places], asked.own)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a branch and stage; none of a user's law beyond the dialect that only BEYOND runs.

    Errors:
        BadLaw: a law that cannot be counted.
    """
    import pandas as pd

    from bench.tables.kept_costs import of_controller, of_law

    one = settings.contender(unit.contender)
    try:
        made = of_controller(one, tasks.arm(unit.arm).joints) if unit.arm else of_law(one)
    except BadLaw:
        if unit.engine != BEYOND:
            raise
        made = []
    return pd.DataFrame(made)


EXPERIMENT = Experiment(
    "costs",
    "operations a tick",
    TABLES["costs"],
    units,
    rows,
    takes=tuple(kind for kind in EVERYTHING if kind not in ("axes", "controllers")),
    cost_s=lambda unit: CONTROLLER_S if unit.arm else LAW_S,
    is_tried_first=True,
    compiles=False,
)
