"""The largest K dt of first-order laws, by bisection on episodes of a fixed number of ticks.

On the free body for every law, and on arms for one law by every inverse and behind servos with a lag.

near: errors of NEAR_RAD about each of AXES are no larger after TICKS ticks, after more of them the longer servos lag. A
factor m a tick gives m^TICKS: of the limit a thousandth part makes 1.001^TICKS = 2.7, so that bisection finds it to
about as much.

far: in one tick no error of SCAN_RAD about FAR_AXIS grows, nor is it turned by more than twice its angle, which could
end anywhere. Where that holds the angle falls at every tick from everywhere, and the law is stable whatever the start.
"""

from __future__ import annotations

import math

import numpy as np

import tasks
from bench.base.bisection import bisect
from bench.engines.episode import FAILURE_TICK, FINAL_ANGLE, NEVER
from bench.experiments import velocity
from bench.experiments.experiment import OF_LAWS, Experiment, Unit, user_laws_last
from bench.experiments.limiters import pass_all
from bench.experiments.request import Request
from bench.experiments.suites import BY_EVERY_INVERSE, WITHOUT_FACTOR
from bench.law.contenders import combinations
from bench.law.contenders.registry import find_contender
from tasks.base import Start
from tasks.rotations import about, multiply

LAW_S, ARM_S = 0.01, 0.4
"""CPU seconds a law on the free body, and an inverse on an arm."""

TICKS, NEAR_RAD, GREATEST = 1000, 1e-3, 64.0
"""K dt is looked for below GREATEST."""

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 2.0, 3.0))
FAR_AXIS, SCAN_RAD = (1.0, 2.0, 3.0), np.linspace(1e-3, math.pi - 1e-3, 400)

BISECTIONS = 24
"""Halvings of the interval up to 64: 4e-6 is left."""

LAG_TICKS = (0.0, 0.25, 1.0, 4.0)
"""Time constants of servos over the control period."""

DT_S = 0.1
"""The control period has no effect on K dt; with this one commands keep far from the judge's limit of speed."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit a law on the free body; on each arm one for each inverse of one law."""
    some = velocity.velocity_laws(request)
    made = [Unit("velocity-limits", one.name, "free-body") for one in some]
    made += velocity.units_on_arms(request, [one for one in some if one.name == BY_EVERY_INVERSE], "velocity-limits")
    return user_laws_last(made, request)


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return one row a reach and lag."""
    one = request.contender(unit.contender)
    if unit.arm:
        start = [_on_arm(unit.arm)]
        found = [("near", 1.0, lag, near(request, unit, start, lag)) for lag in lags(unit)]
    else:
        begun = [Start("", about(axis, NEAR_RAD)) for axis in AXES]
        limit = near(request, unit, begun, 0.0)
        found = [("near", 1.0, 0.0, limit), ("far", 1.0, 0.0, far(request, unit))]
        if unit.contender == WITHOUT_FACTOR:
            found += [("near", 0.5, 0.0, near(request, unit, begun, 0.0, 0.5))]
    place, names = {"arm": unit.arm, **one.words}, ("reach", "share", "lag_ticks", "k_dt")
    return [place | dict(zip(names, each, strict=True)) for each in found]


def lags(unit: Unit) -> tuple[float, ...]:
    """Return all lags for the standard inverse, and none for others: a lag tells nothing of an inverse."""
    law, _, _ = unit.contender.partition("@")
    standard = combinations.on((f"{law}@geometric+standard",), {law: find_contender(law)}, tasks.arm(unit.arm).joints)
    return LAG_TICKS if unit.contender == standard[0].name else LAG_TICKS[:1]


def _on_arm(name: str) -> Start:
    """Return the arm at home, its goal NEAR_RAD off about an axis of no kind."""
    from tasks.kinematics import kinematics

    judge, q = kinematics(tasks.arm(name)), tasks.arm(name).home
    return judge.start("", q, multiply(about(FAR_AXIS, NEAR_RAD), judge.pose(q)[1]))


def near(request: Request, unit: Unit, begun: list[Start], lag_ticks: float, share: float = 1.0) -> float:
    """Compute the largest K dt at which none of the errors near the goal has grown."""

    def holds(k_dt: float) -> bool:
        made = _run(request, unit, begun, share * k_dt, round(TICKS * (1.0 + lag_ticks)), lag_ticks)
        return bool((made[:, FINAL_ANGLE] <= NEAR_RAD).all())

    return bisect(holds, 0.0, GREATEST, BISECTIONS)[0]


def far(request: Request, unit: Unit) -> float:
    """Compute the largest K dt at which a tick makes no error of SCAN_RAD larger."""
    from bench.engines.plants.velocity import PATH

    begun = [Start("", about(FAR_AXIS, float(angle))) for angle in SCAN_RAD]

    def holds(k_dt: float) -> bool:
        made = _run(request, unit, begun, k_dt, 1)
        return bool(((made[:, FINAL_ANGLE] <= SCAN_RAD) & (made[:, PATH] <= 2.0 * SCAN_RAD)).all())

    return bisect(holds, 0.0, GREATEST, BISECTIONS)[0]


def _run(request: Request, unit: Unit, begun: list, k_dt: float, ticks: int, lag_ticks: float = 0.0) -> np.ndarray:
    """Return rows of `plants.velocity` of episodes that take so many ticks, unless the robot is lost before."""
    from bench.engines.simulate_arms import run_velocity as run

    limits = request.limits(1.0)._replace(dt_s=DT_S, ticks=ticks, hold_ticks=ticks + 1)
    one = request.contender(unit.contender)
    made = run(one, pass_all, k_dt / DT_S, begun, limits, unit.arm, lag_ticks * DT_S)
    made[made[:, FAILURE_TICK] != NEVER, FINAL_ANGLE] = math.inf
    return made


EXPERIMENT = Experiment.of(
    globals(),
    "the largest K dt of first-order laws",
    takes=(*OF_LAWS, "arms"),
    cost_s=lambda unit: ARM_S if unit.arm else LAW_S,
    prepare=velocity.prepare,
    ticks=lambda request, unit: 1e6,
)
