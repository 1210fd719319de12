"""Operations a tick: of every law of ours, run or not, unless something is named; and of every controller on an arm."""

from __future__ import annotations

import tasks
from bench.base.errors import BadLaw
from bench.base.on_first_use import pd
from bench.experiments import arm, free_body
from bench.experiments.columns import COUNT, Column, read_table
from bench.experiments.experiment import ON_ARMS, Experiment, Unit, user_laws_last
from bench.experiments.kept_rows import kept
from bench.experiments.request import Request
from bench.experiments.traces import laws
from bench.law.contender import Contender
from bench.law.contenders.registry import all_contenders

LAW_S, CONTROLLER_S = 0.2, 1.0
"""CPU seconds of counting; none where it has been counted before."""

BEYOND = "reference"
"""The engine of a unit whose law may be beyond what can be counted, for this engine alone runs it."""


def operations() -> list[Column]:
    """Return a column for each operation that is counted."""
    from bench.engines.counting import OPERATIONS

    return [Column(name, COUNT, "1", f"{name} operations a tick") for name in OPERATIONS]


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit a law, then one for each controller and number of joints that it is run with; a user's last."""
    on_arms: dict = {}
    for unit in arm.units(request):
        on_arms.setdefault((unit.contender, tasks.arm(unit.arm).joints), unit.arm)
    ours = () if request.named_kinds else all_contenders()
    names = dict.fromkeys(one.name for one in (*ours, *laws(request)))
    places = [*((name, "") for name in names), *((name, on) for (name, _), on in on_arms.items())]
    is_beyond = all(unit.engine == BEYOND for unit in (*free_body.units(request), *arm.units(request)))
    engine = BEYOND if is_beyond else ""
    return user_laws_last([Unit("costs", name, arm=on, engine=engine) for name, on in places], request)


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return a row a branch and stage; none of a user's law that only BEYOND runs; BadLaw if it cannot be counted."""
    one = request.contender(unit.contender)
    try:
        return count_operations(one, tasks.arm(unit.arm).joints if unit.arm else 0)
    except BadLaw:
        if unit.engine != BEYOND:
            raise
        return []


def is_whole(request: Request, unit: Unit, rows: pd.DataFrame) -> bool:
    """Tell whether both branches have the same stages, or there are no rows where there may be none."""
    stages = {branch: tuple(some) for branch, some in rows.groupby("branch", observed=True)["stage"]}
    expected = unit.engine == BEYOND and not len(rows)
    return expected or (set(stages) == {"typical", "worst"} and len(set(stages.values())) == 1)


def count_operations(one: Contender, joints: int = 0) -> list[dict]:
    """Count the operations of a law, or of a controller on so many joints; ours stay on disk: all take ten seconds."""
    from bench.engines import counting

    def rows() -> list[dict]:
        return counting.rows_on_arm(one, joints) if joints else counting.rows([one])

    return rows() if one.regulator.origin else kept(f"costs/{one.name}{f'-{joints}' if joints else ''}", rows)


EXPERIMENT = Experiment.of(
    globals(),
    "operations a tick",
    table=read_table(__file__, "costs", OPERATIONS=operations),
    takes=ON_ARMS,
    cost_s=lambda unit: CONTROLLER_S if unit.arm else LAW_S,
    is_tried_first=True,
    compiles=False,
)
