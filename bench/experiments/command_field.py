"""What a law commands, as a function of state: stiffness and damping, dead points, jumps, how hard it pulls."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.experiments.episodes import prepare
from bench.experiments.experiment import OF_LAWS, Asked, Experiment, Settings, Unit, own_last
from bench.experiments.traces import laws
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "command-field"

LAW_S, CALLS = 0.4, 150_000
"""CPU seconds and, at most, calls of a law."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit for each law on the free body, a user's last."""
    made = [Unit(NAME, one.name, "free-body", engine="ideal-held", count=1, total=1) for one in laws(asked)]
    return own_last(made, asked.own)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a finding."""
    import pandas as pd

    from bench.experiments.rows.command_field import findings
    from bench.experiments.rows.episodes import contender_columns

    one = settings.contender(unit.contender)
    found = pd.DataFrame(findings(one, settings.gains))
    for name, stem, parts in (("quat", "quat_", "wxyz"), ("goal", "goal_quat_", "wxyz"), ("u", "u_", "xyz")):
        vectors = pd.DataFrame(found.pop(name).map(tuple).tolist(), columns=[stem + part for part in parts])
        found = found.join(vectors.astype(float))
    return found.assign(**contender_columns(one))


EXPERIMENT = Experiment(
    NAME,
    "commands over all states",
    TABLES[NAME],
    units,
    rows,
    cost_s=lambda unit: LAW_S,
    takes=OF_LAWS,
    prepare=prepare,
    ticks=lambda settings, unit: CALLS,
)
