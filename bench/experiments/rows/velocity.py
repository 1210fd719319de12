"""Episodes of robots that are told velocities, and their rows.

On arms each start is run twice, the second time with its joints turned by 1e-12 rad: what a singularity makes of
rounding shows.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd

import tasks
from bench.contenders.registry import known_limiters
from bench.engines.episode import FINAL_ANGLE, OUTCOME
from bench.engines.plants.velocity import BENT, FURTHEST, OFF, PATH, PEAK, RATE
from bench.engines.simulate_arms import run_velocity as run
from bench.experiments import starts
from bench.experiments.experiment import Settings, Unit
from bench.experiments.rows.episodes import contender_columns, judged_columns
from bench.experiments.suites import AT_VELOCITIES, SUITES, WITHOUT_FACTOR
from bench.tables.schema import TABLES
from tasks.base import Start
from tasks.truth import angle
from tasks.verdict import OUTCOMES

LAGS_S = (0.0, 0.05)
"""Time constants of servos: none, and one that with K = 10/s makes K T = 1/2, twice what does not overshoot."""

BESIDE_RAD = 1e-12

NONE = "none"
"""The limiter that limits nothing."""

CHANGED = (PATH, FURTHEST, PEAK, RATE, OFF)
"""Numbers in which rounding is looked for."""


class Part(NamedTuple):
    """Starts of a unit that are run alike."""

    start_set: str
    starts: list[Start]
    limiter: str = NONE
    share: float = 1.0
    lag_s: float = 0.0


def gain(settings: Settings) -> float:
    """K [1/s]: the loop's pole is where the paper's gains have two."""
    return math.sqrt(settings.gains.kp)


def parts(settings: Settings, unit: Unit) -> Iterator[Part]:
    """What a unit runs."""
    if unit.arm:
        for name in AT_VELOCITIES:
            some = starts.on_arm(name, unit.count, settings.seed, unit.arm)
            yield from (Part(name, some, lag_s=lag_s) for lag_s in LAGS_S)
        return
    uniform = tasks.start_set("uniform", unit.count, settings.seed)
    exact = [start for start in tasks.start_set("half-turn") if start.quat_wxyz[0] == 0.0]
    few = uniform[: SUITES[settings.suite].velocity.limited if settings.suite in SUITES else unit.count]
    for share in (1.0, 0.5) if unit.contender == WITHOUT_FACTOR else (1.0,):
        yield Part("uniform", uniform, share=share)
        yield Part("half-turn", exact, share=share)
        yield from (Part("uniform", few, name, share) for name in known_limiters() if name != NONE)


def frame(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The rows of a unit."""
    every = list(parts(settings, unit))
    lengths = [len(part.starts) for part in every]
    numbers = np.vstack([_run(settings, unit, part, part.starts) for part in every])
    some = [start for part in every for start in part.starts]
    angle0 = np.array([angle(start.quat_wxyz, start.goal_wxyz) for start in some])
    one = settings.contender(unit.contender)
    columns = {
        "suite": settings.suite,
        "arm": unit.arm,
        **contender_columns(one),
        **{name: np.repeat([getattr(part, name) for part in every], lengths) for name in PLACED},
        "start_id": [start.id for start in some],
        "angle0_rad": angle0,
        "gain": gain(settings),
        "dt_s": settings.dt_s,
        "horizon_s": unit.horizon_s,
        **judged_columns(numbers, settings.dt_s),
        "path_ratio": numbers[:, PATH] / angle0,
        "furthest_rad": np.fmax(2.0 * np.arcsin(np.sqrt(np.fmin(numbers[:, FURTHEST], 1.0))), numbers[:, FINAL_ANGLE]),
        "bent_rad": numbers[:, BENT],
        "peak_omega": numbers[:, PEAK],
        "peak_rate": numbers[:, RATE] if unit.arm else np.nan,
        "off_m": numbers[:, OFF] if unit.arm else np.nan,
    }
    if unit.arm:
        beside = np.vstack([_run(settings, unit, part, list(map(_turned, part.starts))) for part in every])
        columns |= _rounding(numbers, beside)
    else:
        columns |= {"rounding_change": np.nan, "outcome_beside": ""}
    return pd.DataFrame(columns)[TABLES["velocity"].names]


PLACED = ("share", "limiter", "lag_s", "start_set")


def _run(settings: Settings, unit: Unit, part: Part, some: list[Start]) -> np.ndarray:
    one, limiter = settings.contender(unit.contender), known_limiters()[part.limiter]
    K = part.share * gain(settings)
    return run(one, limiter, K, some, settings.limits(unit.horizon_s), unit.arm, part.lag_s)


def _turned(start: Start) -> Start:
    """The start with every joint 1e-12 rad further."""
    return start._replace(q=tuple(x + BESIDE_RAD for x in start.q))


def _rounding(numbers: np.ndarray, beside: np.ndarray) -> dict:
    """What 1e-12 rad made of each row: the largest relative change, and the outcome if it is another."""
    was, now = numbers[:, CHANGED], beside[:, CHANGED]
    with np.errstate(invalid="ignore"):
        change = np.abs(now - was) / np.maximum(np.abs(was), 1e-6)
    outcomes = ([OUTCOMES[int(code)] for code in rows[:, OUTCOME]] for rows in (numbers, beside))
    return {
        "rounding_change": np.nan_to_num(change, nan=math.inf, posinf=math.inf).max(axis=1),
        "outcome_beside": [other if other != one else "" for one, other in zip(*outcomes, strict=True)],
    }
