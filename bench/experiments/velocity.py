"""Velocity-commanded robots: every law as omega = K f(R, R_d), on the free body and resolved on arms.

On the free body from uniform starts and exact 180° rotations, and behind every limiter; on arms by the standard
inverse, one law by every inverse, by servos that follow at once and by servos with a lag. K is sqrt(kp), the pole that
the paper's gains have twice. On arms each start is run twice, the second time with its joints turned by 1e-12 rad: what
a singularity makes of rounding shows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import tasks
from bench.engines.episode import FINAL_ANGLE, OUTCOME
from bench.experiments import arm, starts
from bench.experiments.episode_rows import episode_columns
from bench.experiments.experiment import OF_LAWS, Experiment, Unit, user_laws_last
from bench.experiments.limiters import LIMITERS, NONE
from bench.experiments.request import Request
from bench.experiments.rounding import NUDGE, nudged
from bench.experiments.suites import AT_VELOCITIES, BY_EVERY_INVERSE, SUITES, WITHOUT_FACTOR
from bench.experiments.traces import laws
from bench.law.contender import Contender, refusal
from bench.law.contenders import combinations
from bench.law.contenders.registry import contenders
from bench.law.control.velocity import is_velocity_law
from tasks.base import Start
from tasks.verdict import OUTCOMES

HORIZON_S = 2.5
"""25 time constants 1/K: what leaves a 180° rotation by rounding alone, 1e-11 rad off it, is still on its way."""

EPISODE_S = {"": 2e-4, "arm": 3e-3}
"""CPU seconds an episode, medians."""

LAGS_S = (0.0, 0.05)
"""Time constants of servos: none, and one that with K = 10/s makes K T = 1/2, twice what does not overshoot."""

PLACED = ("share", "limiter", "lag_s", "start_set")


class Part(NamedTuple):
    """Starts of a unit that are run alike."""

    start_set: str
    starts: list[Start]
    limiter: str = NONE
    share: float = 1.0
    lag_s: float = 0.0


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit a law on the free body, and one a law, inverse and arm; a user's last."""
    section, some = request.section("velocity"), velocity_laws(request)
    made = [Unit("velocity", one.name, "free-body", count=section["starts"], horizon_s=HORIZON_S) for one in some]
    made += units_on_arms(request, some, "velocity", count=section["on_arms"], horizon_s=HORIZON_S)
    return user_laws_last(made, request)


def units_on_arms(request: Request, laws: list[Contender], experiment: str, **more: Any) -> Iterator[Unit]:
    """Yield a unit a law and inverse on each arm of the plan."""
    for name in dict.fromkeys(unit.arm for unit in arm.units(request)):
        for one in (one for law in laws for one in on_joints(law, tasks.arm(name).joints)):
            yield Unit(experiment, one.name, "arm-regulation", name, **more)


def velocity_laws(request: Request) -> list[Contender]:
    """Return the laws whose command at rest is an error vector: on R or the paper's coordinates, a user's, or named."""
    is_named = request.names_laws
    return [
        one
        for one in laws(request)
        if is_velocity_law(one) and (is_named or one.regulator.origin or not one.uses_nonpaper_coordinates)
    ]


def on_joints(law: Contender, joints: int) -> list[Contender]:
    """Return a law by the geometric Jacobian and the standard inverse, or by every one that fits."""
    standard = combinations.on((f"{law.name}@geometric+standard",), {law.name: law}, joints)
    if law.name != BY_EVERY_INVERSE:
        return standard
    every = (standard[0]._replace(inverse=one) for one in contenders("inverses").values() if not one.uses_inertia)
    return [one for one in every if not refusal(one, joints)]


def rows(request: Request, unit: Unit) -> dict:
    """Return one row an episode, as columns."""
    from bench.engines.plants.velocity import BENT, FURTHEST, OFF, PATH, PEAK, RATE

    every = list(parts(request, unit))
    lengths = [len(part.starts) for part in every]
    made = np.vstack([_run(request, unit, part, part.starts) for part in every])
    some = [start for part in every for start in part.starts]
    ran = episode_columns(request, some, made, request.dt_s, unit.horizon_s)
    one = request.contender(unit.contender)
    found = {
        **ran,
        "arm": unit.arm,
        **one.words,
        **{name: np.repeat([getattr(part, name) for part in every], lengths) for name in PLACED},
        "gain": gain(request),
        "path_ratio": made[:, PATH] / ran["angle0_rad"],
        "furthest_rad": np.fmax(2.0 * np.arcsin(np.sqrt(np.fmin(made[:, FURTHEST], 1.0))), made[:, FINAL_ANGLE]),
        "bent_rad": made[:, BENT],
        "peak_omega": made[:, PEAK],
        "peak_rate": made[:, RATE] if unit.arm else np.nan,
        "off_m": made[:, OFF] if unit.arm else np.nan,
    }
    if unit.arm:
        changed = [OUTCOME, PATH, FURTHEST, PEAK, RATE, OFF]
        there = []
        for part in every:
            nudged_starts = [nudged(start, NUDGE) for start in part.starts]
            there.append(_run(request, unit, part, nudged_starts))
        found |= compare_nudged(made[:, changed], np.vstack(there)[:, changed])
    else:
        found |= {"rounding_change": np.nan, "outcome_beside": ""}
    return found


def gain(request: Request) -> float:
    """Return K [1/s]: the loop's pole is where the paper's gains have two."""
    return math.sqrt(request.gains.kp)


def parts(request: Request, unit: Unit) -> Iterator[Part]:
    """Yield what a unit runs."""
    if unit.arm:
        for name in AT_VELOCITIES:
            some = starts.on_arm(name, unit.count, request.seed, unit.arm)
            yield from (Part(name, some, lag_s=lag_s) for lag_s in LAGS_S)
        return
    uniform = tasks.start_set("uniform", unit.count, request.seed)
    exact = [start for start in tasks.start_set("half-turn") if start.quat_wxyz[0] == 0.0]
    few = uniform[: request.section("velocity")["limited"]] if request.suite in SUITES else uniform
    for share in (1.0, 0.5) if unit.contender == WITHOUT_FACTOR else (1.0,):
        yield Part("uniform", uniform, share=share)
        yield Part("half-turn", exact, share=share)
        yield from (Part("uniform", few, name, share) for name in LIMITERS if name != NONE)


def _run(request: Request, unit: Unit, part: Part, some: list[Start]) -> np.ndarray:
    from bench.engines.simulate_arms import run_velocity as run

    one, limit = request.contender(unit.contender), LIMITERS[part.limiter].limit
    K = part.share * gain(request)
    return run(one, limit, K, some, request.limits(unit.horizon_s), unit.arm, part.lag_s)


def compare_nudged(here: np.ndarray, there: np.ndarray) -> dict:
    """Compare each row, an outcome and numbers, with the run from a start 1e-12 rad away.

    Return the largest relative change of its numbers, and the other outcome if there is one.
    """
    was, now = here[:, 1:], there[:, 1:]
    with np.errstate(invalid="ignore"):
        change = np.abs(now - was) / np.maximum(np.abs(was), 1e-6)
    outcomes = ([OUTCOMES[int(code)] for code in each[:, 0]] for each in (here, there))
    return {
        "rounding_change": np.nan_to_num(change, nan=math.inf, posinf=math.inf).max(axis=1),
        "outcome_beside": [other if other != one else "" for one, other in zip(*outcomes, strict=True)],
    }


def prepare(request: Request, unit: Unit) -> None:
    """Compile the loops, the limiters, the law and the inverse."""
    for limiter in LIMITERS:
        _run(request, unit, Part("", [], limiter), [])


EXPERIMENT = Experiment.of(
    globals(),
    "first-order laws: robots commanded in velocity",
    takes=(*OF_LAWS, "arms"),
    cost_s=lambda unit: unit.count * (8.0 * EPISODE_S["arm"] if unit.arm else 4.0 * EPISODE_S[""]),
    ticks=lambda request, unit: 8.0 * unit.count * unit.horizon_s / request.dt_s,
)
