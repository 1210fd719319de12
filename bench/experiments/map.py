"""Maps: what becomes of millions of random starts, counted in cells of SO(3); no suite has them, `map` has."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bench.experiments.experiment import Experiment, Settings, Unit
from bench.experiments.plan import Plan
from bench.experiments.suites import SHORT
from bench.law.contender import PAPERS_GAINS, Contender, Gains
from bench.tables.schema import TABLES
from tasks.random_starts import BLOCK

if TYPE_CHECKING:
    import pandas as pd

UNIT = 8 * BLOCK
"""Starts of a unit: 131,072, some four seconds on one thread."""

START_S = 3e-5
"""CPU seconds a start."""


def plan_of(
    laws: list[Contender],
    starts: int,
    *,
    seed: int = 0,
    speeds: tuple[tuple[float, float], ...] = ((0.0, 0.0),),
    engine: str = "ideal-rk4",
    dt_s: float = 1e-3,
    horizon_s: float = SHORT,
    gains: Gains = PAPERS_GAINS,
) -> Plan:
    """A map of each law from the same orientations, at speeds between the least and the most of each pair [rad/s]."""
    units = (
        Unit(
            "map",
            one.name,
            "free-body",
            engine=engine,
            selector=f"speed-{least:g}to{most:g}",
            first=first,
            count=min(UNIT, starts - first),
            total=starts * len(speeds),
            episodes=min(UNIT, starts - first),
            horizon_s=horizon_s,
        )
        for one in laws
        for least, most in speeds
        for first in range(0, starts, UNIT)
    )
    own = tuple(dict.fromkeys(one.regulator for one in laws if one.regulator.origin))
    return Plan(Settings("map", gains, dt_s, seed=seed, own=own), tuple(units))


def speeds_of(unit: Unit) -> tuple[float, float]:
    """The least and the most initial speed of a unit's starts [rad/s]."""
    least, _, most = unit.selector.removeprefix("speed-").partition("to")
    return float(least), float(most)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The cells that a unit's starts lie in, the slowest start of each ring, and the starts that are lost."""
    from bench.experiments.rows.map import rows as counted

    return counted(settings, unit)


def prepare(settings: Settings, unit: Unit) -> None:
    """Compile what runs the law without metrics."""
    from bench.engines import simulate

    simulate.prepare(unit.engine, settings.contender(unit.contender), (), unit.total)


def folded(before: pd.DataFrame, after: pd.DataFrame) -> pd.DataFrame:
    """The rows of two stretches of starts as those of both."""
    from bench.experiments.rows.map import folded as both

    return both(before, after)


EXPERIMENT = Experiment(
    "map",
    "laws from millions of random starts",
    TABLES["map"],
    units=lambda asked: (),
    rows=rows,
    cost_s=lambda unit: unit.count * START_S,
    prepare=prepare,
    fold=folded,
    in_suites=False,
)
