"""Laws of the free body in situations of dimensionless numbers: a row a law and situation, of some hundreds of starts.

No suite has this experiment; `bench advise --run` and the study of the map (`bench/studies/advice.py`) plan it.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.engines.metrics.farthest import FARTHEST
from bench.engines.metrics.metric import Metric
from bench.engines.metrics.registry import known_metrics
from bench.experiments.costs import count_operations
from bench.experiments.episodes import prepare_law
from bench.experiments.experiment import Experiment, Settings, Unit
from bench.experiments.plan import Plan
from bench.experiments.tables.statistics import order_interval, quantile
from bench.law.contender import Contender
from bench.law.contenders.registry import all_contenders
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.situation import KP, NOMINAL, Situation, read_situation
from tasks.verdict import SETTLED

if TYPE_CHECKING:
    from tasks.condition import Condition

FIRST, MOST = 512, 4096
"""Starts of a situation, at first and at most: doubled until the interval of the 99 % time is short enough. A law that
exact 180° rotations hold has a time without a limit near them; of it FIRST suffice."""

PRECISION = 0.01
"""Half of that interval over the time, at most."""

EXACT = 24
"""Starts at exact 180° rotations."""

NOISE_RAD = 0.1
"""Worst error of orientation at 180° [rad]; no sensor's exceeds it by much."""

AWAY_RAD = 0.05
"""Angle to the goal gained by a body that turns away from it [rad]."""

HORIZON_S = 5.0
START_S = 2e-4
"""CPU seconds a start."""

CROWD = 0.99
"""The share of the starts whose settling time is compared."""


def metrics() -> tuple[Metric, ...]:
    """Return what is measured of each start: farthest, effort, peak, overshoot."""
    known = known_metrics()
    return (FARTHEST, known["effort"], known["peak_u"], known["overshoot_rad"])


def mapped_laws() -> list[Contender]:
    """Return the laws on R or its quaternion; on coordinates of SO(3) some starts are lost: none can be advised."""
    every = [one for one in all_contenders() if one.representation is None]
    return [one for one in every if not (one.regulator.in_engine or one.regulator.control)]


def plan_of(pairs: Iterable[tuple[Contender, Situation]], seed: int = 0) -> Plan:
    """Plan laws, each in its situations."""
    every = list(pairs)
    whole = Unit("situations", task="free-body", total=FIRST, horizon_s=HORIZON_S).part(0, FIRST)
    units = tuple(replace(whole, contender=one.name, selector=at.word) for one, at in every)
    own = tuple(dict.fromkeys(one.regulator for one, _ in every if one.regulator.origin))
    return Plan(Settings("situations", seed=seed, own=own), units)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """Return the row of a law in a situation."""
    one, at = settings.contender(unit.contender), read_situation(unit.selector)
    condition, exact = at.condition(), exact_half_turns(EXACT, settings.seed)
    noisy = noisy_condition(at, NOISE_RAD)
    stuck, trapped = (
        int((run_starts(one, at, exact, each, settings.seed)["time"] == math.inf).sum()) for each in (condition, noisy)
    )
    every, is_moving = starts_of(at.spin, at.jump, settings.seed)[: FIRST if stuck else MOST], at.spin + at.jump > 0.0
    ended, count = run_starts(one, at, every[:FIRST], condition, settings.seed), FIRST
    while count < len(every) and not is_precise(summarize(ended, is_moving)):
        more = run_starts(one, at, every[count : 2 * count], condition, settings.seed)
        ended, count = {name: np.concatenate((ended[name], more[name])) for name in more}, 2 * count
    found = summarize(ended, is_moving)
    facts = {"stuck": stuck, "trapped": trapped, "operations": count_typical(one)}
    return pd.DataFrame([{**one.words, **at._asdict(), **found, **facts}])


@functools.lru_cache(maxsize=64)
def starts_of(spin: float, jump: float, seed: int) -> list[Start]:
    """Return the uniform starts of every situation of that spin and jump."""
    return NOMINAL._replace(spin=spin, jump=jump).starts(MOST, seed)


def count_typical(one: Contender) -> int:
    """Return the operations of a typical tick, the goal given as R_d: each flop and each call counted once."""
    whole = next(row for row in count_operations(one) if row["branch"] == "typical" and row["stage"] == "total")
    return int(whole["flops"] + whole["sin"] + whole["cos"] + whole["acos"] + whole["atan2"])


def is_precise(found: dict[str, float]) -> bool:
    """Tell whether the interval of the 99 % time is short enough, or cannot become so: a hundredth does not settle."""
    half = 0.5 * (found["time_high"] - found["time_low"])
    return not math.isfinite(found["time"]) or half <= PRECISION * found["time"]


def summarize(ended: dict[str, np.ndarray], is_moving: bool) -> dict[str, Any]:
    """Return the columns of a row that are made of its starts."""
    times = ended["time"]
    low, high = order_interval(len(times), CROWD)
    ordered = np.sort(times)
    return {
        "starts": len(times),
        "lost": int((times == math.inf).sum()),
        "unwound": 0 if is_moving else int((ended["farthest"] > ended["angle0"] + AWAY_RAD).sum()),
        "median": float(quantile(times, 0.5)),
        "time": float(quantile(times, CROWD)),
        "time_low": float(ordered[low]),
        "time_high": float(ordered[high]),
        "latest": float(quantile(times, 0.999)),
        "slowest": float(ordered[-1]),
        "peak": float(ended["peak_u"].max()) / KP,
        "effort": float(quantile(ended["effort"], 0.5)) / KP**1.5,
        "overshoot": math.degrees(float(quantile(ended["overshoot_rad"], CROWD))),
    }


def exact_half_turns(count: int, seed: int) -> list[Start]:
    """Return starts at exact 180° rotations, at rest."""
    return tasks.axis("half-turn-noise").starts(count, seed, 0.0)


def noisy_condition(at: Situation, noise_rad: float) -> Condition:
    """Return a situation's condition under worst-case noise at 180°, without delay at the shortest period."""
    return at._replace(delay=NOMINAL.delay, period=NOMINAL.period, jump=NOMINAL.jump).condition(noise_rad)


def run_starts(
    one: Contender, at: Situation, starts: list[Start], condition: Condition, seed: int = 0
) -> dict[str, np.ndarray]:
    """Return time (times sqrt(kp); infinite: not settled), angle at first or at the jump, and metrics of each start."""
    from bench.engines.episode import FIRST_METRIC, OUTCOME, SETTLING_TICK
    from bench.engines.episode import Settings as Limits
    from bench.engines.plants import perturbed
    from bench.engines.simulate_bodies import run_disturbed
    from tasks.rules import RULES
    from tasks.truth import angle

    limits = Limits(Gains(KP, at.kv), 1e-6, round(1e6 * HORIZON_S), 1)
    numbers = run_disturbed(one, starts, condition, limits, metrics(), seed)
    step_s = condition.period_s / perturbed.steps_of(condition)
    is_settled = numbers[:, OUTCOME] == SETTLED
    jumped = numbers[:, perturbed.JUMPED - perturbed.EXTRA]
    angle0 = np.array([angle(start.quat_wxyz, start.goal_wxyz) for start in starts])
    angle0 = np.where(jumped > 0.0, jumped, angle0)
    seen = numbers[:, FIRST_METRIC : FIRST_METRIC + 4].T
    overshoot = 2.0 * np.arcsin(np.sqrt(np.minimum(seen[3], 1.0)))
    return {
        "time": np.where(is_settled, numbers[:, SETTLING_TICK] * step_s * math.sqrt(KP), math.inf),
        "angle0": angle0,
        "farthest": 2.0 * np.arcsin(np.sqrt(np.minimum(seen[0], 1.0))),
        "effort": np.where(is_settled, seen[1], math.inf),
        "peak_u": np.sqrt(seen[2]),
        "overshoot_rad": np.where(overshoot > RULES.tolerance * angle0, overshoot, 0.0),
    }


EXPERIMENT = Experiment.of(
    globals(),
    "laws on the free body in situations of dimensionless numbers",
    units=lambda asked: (),
    cost_s=lambda unit: unit.episodes * START_S,
    prepare=lambda settings, unit: prepare_law(settings, unit, "perturbed", metrics()),
    ticks=lambda settings, unit: 3 * MOST * HORIZON_S / 1e-3,
    in_suites=False,
)
