"""Impedance as torque-controlled arms run it, tau = J^T (K e - D v) + g, in free motion: every design of the damping.

Each at the stiffness of libfranka's example and at that of our tasks in contact, with gravity alone compensated and
with Coriolis torques too; the error of orientation is the logarithm.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bench.contenders.registry import find_contender, known_dampings
from bench.experiments import arm
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.experiments.suites import BY_EVERY_INVERSE, ON_ARM
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "impedance"

LAW = BY_EVERY_INVERSE
"""Whose command at rest is the error of orientation: near the goal all are alike."""


class Stiffness(NamedTuple):
    """Of translation [N/m] and of turns [N m/rad]."""

    translation: float
    rotation: float


STIFFNESSES = (Stiffness(150.0, 10.0), Stiffness(2000.0, 50.0))
"""libfranka's example, and kp m_p, kp m_o of the tasks in contact."""

ZETA = 1.0
"""The ratio asked for: the shipped rule's 2 sqrt(K)."""

EPISODE_S = 0.02
"""CPU seconds an episode of five seconds at most, median."""


def of_arms(asked: Asked, name: str, **more) -> tuple[Unit, ...]:
    """A unit a design of damping on each arm of the plan."""
    arms = dict.fromkeys(unit.arm for unit in arm.units(asked))
    return tuple(
        Unit(name, task="arm-regulation", arm=one, selector=word, **more) for one in arms for word in known_dampings()
    )


def units(asked: Asked) -> tuple[Unit, ...]:
    """The designs on arms, as many starts as velocity-commanded robots get."""
    starts = asked.suite.velocity.on_arms
    return of_arms(asked, NAME, count=starts, total=starts, horizon_s=ON_ARM)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row an episode."""
    from bench.experiments.rows.impedance import frame

    return frame(settings, unit)


def prepare(settings: Settings, unit: Unit) -> None:
    """Compile the loop, the error and the design."""
    from bench.engines.simulate_arms import prepare_impedance

    prepare_impedance(find_contender(LAW), (known_dampings()[unit.selector],))


EXPERIMENT = Experiment(
    NAME,
    "impedance without inertia shaping, in free motion",
    TABLES[NAME],
    units,
    rows,
    takes=("tasks", "arms"),
    cost_s=lambda unit: 2.0 * len(STIFFNESSES) * unit.count * EPISODE_S,
    prepare=prepare,
    compiles=False,
)
