"""The largest K dt of first-order laws, by bisection on episodes of a fixed number of ticks.

near: errors of NEAR_RAD about each of AXES are no larger after TICKS ticks, after more of them the longer servos lag. A
factor m a tick gives m^TICKS: of the limit a thousandth part makes 1.001^TICKS = 2.7, so that bisection finds it to
about as much.

far: in one tick no error of SCAN_RAD about FAR_AXIS grows, nor is it turned by more than twice its angle, which could
end anywhere. Where that holds the angle falls at every tick from everywhere, and the law is stable whatever the start.
"""

import math

import numpy as np
import pandas as pd

import tasks
from bench.contenders import combinations
from bench.contenders.registry import find_contender, known_limiters
from bench.engines.episode import FAILURE_TICK, FINAL_ANGLE, NEVER
from bench.engines.plants.velocity import PATH
from bench.engines.simulate_arms import run_velocity as run
from bench.experiments.experiment import Settings, Unit
from bench.experiments.rows.episodes import contender_columns
from bench.experiments.rows.velocity import NONE
from bench.experiments.suites import WITHOUT_FACTOR
from bench.tables.schema import TABLES
from tasks.base import Start
from tasks.kinematics import kinematics
from tasks.rotations import about, multiply

TICKS, NEAR_RAD, GREATEST = 1000, 1e-3, 64.0
"""K dt is looked for below GREATEST."""

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 2.0, 3.0))
FAR_AXIS, SCAN_RAD = (1.0, 2.0, 3.0), np.linspace(1e-3, math.pi - 1e-3, 400)

BISECTIONS = 24
"""Of 64: 4e-6."""

LAG_TICKS = (0.0, 0.25, 1.0, 4.0)
"""Time constants of servos over the control period."""

DT_S = 0.1
"""Of no matter to K dt, but that commands keep far from the judge's limit of speed."""


def frame(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The rows of a unit."""
    one = settings.contender(unit.contender)
    if unit.arm:
        start = [_on_arm(unit.arm)]
        found = [("near", 1.0, lag, near(settings, unit, start, lag)) for lag in lags(unit)]
    else:
        begun = [Start("", about(axis, NEAR_RAD)) for axis in AXES]
        limit = near(settings, unit, begun, 0.0)
        found = [("near", 1.0, 0.0, limit), ("far", 1.0, 0.0, far(settings, unit))]
        if unit.contender == WITHOUT_FACTOR:
            found += [("near", 0.5, 0.0, near(settings, unit, begun, 0.0, 0.5))]
    rows = pd.DataFrame(found, columns=["reach", "share", "lag_ticks", "k_dt"])
    return rows.assign(arm=unit.arm, **contender_columns(one))[TABLES["velocity-limits"].names]


def lags(unit: Unit) -> tuple[float, ...]:
    """A lag tells nothing of an inverse: all of them behind the standard one alone."""
    law, _, _ = unit.contender.partition("@")
    standard = combinations.on((f"{law}@geometric+standard",), {law: find_contender(law)}, tasks.arm(unit.arm).joints)
    return LAG_TICKS if unit.contender == standard[0].name else LAG_TICKS[:1]


def _on_arm(name: str) -> Start:
    """The arm at home, its goal NEAR_RAD off about an axis of no kind."""
    judge = kinematics(tasks.arm(name))
    q = pose(name)
    return judge.start("", q, multiply(about(FAR_AXIS, NEAR_RAD), judge.pose(q)[1]))


def pose(name: str) -> tuple[float, ...]:
    """Joint angles at which an arm's limits are measured: its home."""
    return tasks.arm(name).home


def near(settings: Settings, unit: Unit, begun: list[Start], lag_ticks: float, share: float = 1.0) -> float:
    """The largest K dt at which none of the errors near the goal has grown."""

    def holds(k_dt: float) -> bool:
        rows = _run(settings, unit, begun, share * k_dt, round(TICKS * (1.0 + lag_ticks)), lag_ticks)
        return bool((rows[:, FINAL_ANGLE] <= NEAR_RAD).all())

    return _bisected(holds)


def far(settings: Settings, unit: Unit) -> float:
    """The largest K dt at which a tick makes no error of SCAN_RAD larger."""
    begun = [Start("", about(FAR_AXIS, float(angle))) for angle in SCAN_RAD]

    def holds(k_dt: float) -> bool:
        rows = _run(settings, unit, begun, k_dt, 1)
        return bool(((rows[:, FINAL_ANGLE] <= SCAN_RAD) & (rows[:, PATH] <= 2.0 * SCAN_RAD)).all())

    return _bisected(holds)


def _run(settings: Settings, unit: Unit, begun, k_dt: float, ticks: int, lag_ticks: float = 0.0) -> np.ndarray:
    """Rows of `plants.velocity` of episodes that take so many ticks, unless the robot is lost on the way."""
    limits = settings.limits(1.0)._replace(dt_s=DT_S, ticks=ticks, hold_ticks=ticks + 1)
    one, none = settings.contender(unit.contender), known_limiters()[NONE]
    rows = run(one, none, k_dt / DT_S, begun, limits, unit.arm, lag_ticks * DT_S)
    rows[rows[:, FAILURE_TICK] != NEVER, FINAL_ANGLE] = math.inf
    return rows


def _bisected(holds) -> float:
    """The largest number below GREATEST up to which something holds."""
    low, high = 0.0, GREATEST
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low
