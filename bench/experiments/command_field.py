"""What a law commands, as a function of state: stiffness, dead points, jumps, the way it pulls, how it rests."""

from __future__ import annotations

import pandas as pd

from bench.experiments.episodes import prepare
from bench.experiments.experiment import Asked, Experiment, Settings, Unit, own_last
from bench.experiments.traces import laws
from bench.law.contender import Contender
from bench.tables.schema import TABLES

NAME = "command-field"

LAW_S = 0.4
"""CPU seconds a law."""

CALLS = 300_000
"""Of a law, at most."""

SHOWN = ("stiffness", "damping", "dead-half-turns", "no-number-half-turns", "jump-half-turns", "jump-elsewhere", "rest")


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit for each law on the free body, a user's last; none where start sets or engines alone are asked for."""
    if asked.choice.narrows and NAME not in asked.choice.experiments:
        return ()
    return own_last([of_law(one) for one in laws(asked)], asked.own)


def of_law(one: Contender) -> Unit:
    """The unit of a law."""
    return Unit(NAME, one.name, "free-body", engine="ideal-held", count=1, total=1)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row a finding."""
    from bench.experiments.rows.command_field import findings
    from bench.experiments.rows.episodes import contender_columns

    one = settings.contender(unit.contender)
    found = pd.DataFrame(findings(one, settings.gains, settings.seed))
    for name, stem, parts in (("quat", "quat_", "wxyz"), ("goal", "goal_quat_", "wxyz"), ("u", "u_", "xyz")):
        vectors = pd.DataFrame(found.pop(name).map(tuple).tolist(), columns=[stem + part for part in parts])
        found = found.join(vectors.astype(float))
    return found.assign(**contender_columns(one))


def summary(frame: pd.DataFrame) -> pd.DataFrame:
    """One line a law: what is found of SHOWN."""
    from bench.tables.read import with_contender

    counted = " " + frame["found"].astype(str) + "/" + frame["of"].astype(str)
    cells = frame["what"].astype(str) + counted.where(frame["found"] > 0, "")
    words = with_contender(frame).assign(cell=cells).pivot(index="contender", columns="finding", values="cell")
    return words.reindex(columns=list(SHOWN)).rename_axis(index="law", columns=None).reset_index().astype({"law": str})


EXPERIMENT = Experiment(
    NAME,
    "commands over all states (a/b: in a of b that were tried)",
    TABLES[NAME],
    units,
    rows,
    cost_s=lambda unit: LAW_S,
    prepare=prepare,
    ticks=lambda settings, unit: CALLS,
    summary=summary,
)
