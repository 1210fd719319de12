"""Velocity-commanded robots: every law as omega = K f(R, R_d), on the free body and resolved on arms.

On the free body from uniform starts and exact 180° rotations, and behind every limiter; on arms by the standard
inverse, one law by every inverse, by servos that follow at once and by servos with a lag. K is sqrt(kp), the pole that
the paper's gains have twice.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import tasks
from bench.contenders import combinations
from bench.contenders.registry import known_inverses, known_limiters
from bench.control.velocity import is_velocity_law
from bench.experiments import arm
from bench.experiments.experiment import OF_LAWS, Asked, Experiment, Settings, Unit, own_last
from bench.experiments.suites import BY_EVERY_INVERSE
from bench.experiments.traces import laws
from bench.law.contender import Contender, refusal
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

NAME = "velocity"

HORIZON_S = 2.5
"""25 time constants 1/K: what leaves a 180° rotation by rounding alone, 1e-11 rad off it, is still on its way."""

EPISODE_S = {"": 2e-4, "arm": 3e-3}
"""CPU seconds an episode, medians."""


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit a law on the free body, and one a law, inverse and arm; a user's last."""
    part, some = asked.suite.velocity, velocity_laws(asked)
    made = [Unit(NAME, one.name, "free-body", count=part.starts, horizon_s=HORIZON_S) for one in some]
    for name in dict.fromkeys(unit.arm for unit in arm.units(asked)):
        made += [
            Unit(NAME, one.name, "arm-regulation", name, count=part.on_arms, horizon_s=HORIZON_S)
            for law in some
            for one in on_joints(law, tasks.arm(name).joints)
        ]
    return own_last(made, asked.own)


def velocity_laws(asked: Asked) -> list[Contender]:
    """The laws whose command at rest is an error vector: on R or the paper's coordinates, a user's, or named."""
    is_named = asked.choice.is_of_some_laws
    return [
        one
        for one in laws(asked)
        if is_velocity_law(one) and (is_named or one.regulator.origin or not one.is_elsewhere)
    ]


def on_joints(law: Contender, joints: int) -> list[Contender]:
    """A law by the geometric Jacobian and the standard inverse, or by every one that fits."""
    if law.name != BY_EVERY_INVERSE:
        return combinations.on((f"{law.name}@geometric+standard",), {law.name: law}, joints)
    (by, *_) = combinations.on((f"{law.name}@geometric+standard",), {law.name: law}, joints)
    return [one for every in known_inverses().values() if not refusal(one := by._replace(inverse=every), joints)]


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """One row an episode."""
    from bench.experiments.rows.velocity import frame

    return frame(settings, unit)


def prepare(settings: Settings, unit: Unit) -> None:
    """Compile the loops, the limiters, the law and the inverse."""
    from bench.engines.simulate_arms import prepare_velocity

    one = settings.contender(unit.contender)
    prepare_velocity(one, known_limiters().values())


EXPERIMENT = Experiment(
    NAME,
    "first-order laws: robots that are told velocities",
    TABLES[NAME],
    units,
    rows,
    takes=(*OF_LAWS, "arms"),
    cost_s=lambda unit: unit.count * (8.0 * EPISODE_S["arm"] if unit.arm else 4.0 * EPISODE_S[""]),
    prepare=prepare,
    ticks=lambda settings, unit: 8.0 * unit.count * unit.horizon_s / settings.dt_s,
)
