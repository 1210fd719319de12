"""Laws of the free body in situations of dimensionless numbers: a unit a law and situation, a row a start.

`summarize` makes of its rows those of situations.parquet, a row a law and situation. Starts are independent draws, so
that intervals by order statistics hold; all laws of a situation have the same starts, so that two laws can be compared
start by start (`bench.findings.selection.pairs`). No suite has this experiment; `bench advise --run` and the study of
the map (`bench/studies/situations.py`) plan it.
"""

from __future__ import annotations

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
from bench.experiments.columns import CONTENDER_KEY, read_table
from bench.experiments.costs import count_operations
from bench.experiments.episodes import prepare_law
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.tables.statistics import order_interval, quantile
from bench.law.contender import Contender
from bench.law.contenders.registry import all_contenders
from bench.law.inputs import Gains
from bench.law.kinds import ACTUATOR, CONTROL
from tasks.base import Start
from tasks.situation import KP, NOMINAL, Situation, read_situation
from tasks.verdict import SETTLED

if TYPE_CHECKING:
    from tasks.condition import Condition

FIRST, MOST = 512, 2048
"""Starts of a situation, at first and at most: doubled until the interval of the 99 % time is short enough. A law that
exact 180° rotations hold has a time without a limit near them; of it FIRST suffice."""

PRECISION = 0.02
"""Half of that interval over the time, at most. Two laws are compared start by start, which is more precise."""

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
    return [one for one in every if one.regulator.role not in (ACTUATOR, CONTROL)]


def plan_of(pairs: Iterable[tuple[Contender, Situation]], seed: int = 0) -> Plan:
    """Plan laws, each in its situations; seed: of the draw of the starts."""
    every = list(pairs)
    whole = Unit("situations", task="free-body", total=FIRST, horizon_s=HORIZON_S).part(0, FIRST)
    units = tuple(replace(whole, contender=law.name, selector=situation.word) for law, situation in every)
    laws = tuple(dict.fromkeys(law for law, _ in every))
    return Plan(Request("situations", laws, seed=seed), units)


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return a row for each start of a law in a situation: exact 180° rotations, the same with noise, and the drawn."""
    contender, situation = request.contender(unit.contender), read_situation(unit.selector)
    condition = situation.condition()
    exact, noisy = run_half_turns(request, contender, situation)
    is_stuck = not np.isfinite(exact["time"]).all()
    most = FIRST if is_stuck else MOST
    drawn = run_starts(request, contender, situation, situation.starts(FIRST, request.seed), condition)
    while (count := len(drawn["time"])) < most and not is_precise(drawn["time"]):
        further = situation.starts(2 * count, request.seed)[count:]
        more = run_starts(request, contender, situation, further, condition)
        drawn = {name: np.concatenate((drawn[name], more[name])) for name in more}
    sets = {"exact": exact, "noisy": noisy, "drawn": drawn}
    frames = [
        pd.DataFrame({"start_set": name, "start": np.arange(len(numbers["time"])), **numbers})
        for name, numbers in sets.items()
    ]
    same = {**contender.words, "situation": situation.word, "operations": count_typical(contender)}
    return pd.concat(frames, ignore_index=True).assign(**same)


def is_precise(times: np.ndarray) -> bool:
    """Tell whether the interval of the 99 % time is short enough, or cannot become so: a hundredth does not settle."""
    time = float(quantile(times, CROWD))
    low, high = order_interval(len(times), CROWD)
    ordered = np.sort(times)
    return not math.isfinite(time) or 0.5 * (ordered[high] - ordered[low]) <= PRECISION * time


def summarize(starts: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of situations.parquet, a law and situation each, of the rows of all their starts."""
    key = [*CONTENDER_KEY, "situation"]
    found = []
    for values, rows_of_law in starts.groupby(key, sort=False, observed=True):
        *words, word = map(str, values)
        sets = {str(name): each for name, each in rows_of_law.groupby("start_set", observed=True)}
        found.append(
            {
                **dict(zip(CONTENDER_KEY, words, strict=True)),
                **read_situation(word)._asdict(),
                **summarize_drawn(sets["drawn"]),
                "stuck": int((sets["exact"]["time"] == math.inf).sum()),
                "trapped": int((sets["noisy"]["time"] == math.inf).sum()),
                "operations": int(rows_of_law["operations"].iloc[0]),
            }
        )
    return pd.DataFrame(found)


def summarize_drawn(starts: pd.DataFrame) -> dict[str, Any]:
    """Return the columns of a row that are made of its drawn starts.

    They are independent draws, for which the interval by order statistics holds (`order_interval`).
    """
    times = starts["time"].to_numpy()
    low, high = order_interval(len(times), CROWD)
    ordered = np.sort(times)
    return {
        "starts": len(times),
        "lost": int((times == math.inf).sum()),
        "unwound": int(starts["turned_away"].sum()),
        "median": float(quantile(times, 0.5)),
        "time": float(quantile(times, CROWD)),
        "time_low": float(ordered[low]),
        "time_high": float(ordered[high]),
        "latest": float(quantile(times, 0.999)),
        "slowest": float(ordered[-1]),
        "peak": float(starts["peak"].max()),
        "effort": float(quantile(starts["effort"].to_numpy(), 0.5)),
        "overshoot": float(quantile(starts["overshoot"].to_numpy(), CROWD)),
    }


def count_typical(one: Contender) -> int:
    """Return the operations of a typical tick, the goal given as R_d: each flop and each call counted once."""
    whole = next(row for row in count_operations(one) if row["branch"] == "typical" and row["stage"] == "total")
    return int(whole["flops"] + whole["sin"] + whole["cos"] + whole["acos"] + whole["atan2"])


def run_half_turns(
    request: Request, contender: Contender, situation: Situation
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return the numbers of exact 180° rotations in a situation, and of the same under worst-case noise at 180°.

    The noise comes without delay at the shortest period.
    """
    at_rest = situation._replace(delay=NOMINAL.delay, period=NOMINAL.period, jump=NOMINAL.jump)
    starts = tasks.axis("half-turn-noise").starts(EXACT, request.seed, 0.0)
    exact = run_starts(request, contender, situation, starts, situation.condition())
    noisy = run_starts(request, contender, situation, starts, at_rest.condition(NOISE_RAD))
    return exact, noisy


def run_starts(
    request: Request, contender: Contender, situation: Situation, starts: list[Start], condition: Condition
) -> dict[str, np.ndarray]:
    """Return the numbers of each start as the columns of settling.parquet have them."""
    from bench.engines.episode import FIRST_METRIC, OUTCOME, SETTLING_TICK
    from bench.engines.episode import Settings as Limits
    from bench.engines.plants import perturbed
    from bench.engines.simulate_bodies import run_disturbed
    from tasks.rules import RULES
    from tasks.truth import angle

    limits = Limits(Gains(KP, situation.kv), 1e-6, round(1e6 * HORIZON_S), 1)
    numbers = run_disturbed(contender, starts, condition, limits, metrics(), request.seed)
    step_s = condition.period_s / perturbed.steps_of(condition)
    is_settled = numbers[:, OUTCOME] == SETTLED
    at_jump = numbers[:, perturbed.JUMPED - perturbed.EXTRA]
    at_start = np.array([angle(start.quat_wxyz, start.goal_wxyz) for start in starts])
    first_angle = np.where(at_jump > 0.0, at_jump, at_start)
    farthest, effort, peak, overshoot = numbers[:, FIRST_METRIC : FIRST_METRIC + 4].T
    farthest_angle = 2.0 * np.arcsin(np.sqrt(np.minimum(farthest, 1.0)))
    overshoot_angle = 2.0 * np.arcsin(np.sqrt(np.minimum(overshoot, 1.0)))
    is_past = overshoot_angle > RULES.tolerance * first_angle
    # A body that spins, or whose goal jumps, may have to turn away first.
    is_moving = situation.spin + situation.jump > 0.0
    turned_away = (farthest_angle > first_angle + AWAY_RAD) & (not is_moving)
    return {
        "time": np.where(is_settled, numbers[:, SETTLING_TICK] * step_s * math.sqrt(KP), math.inf),
        "turned_away": turned_away.astype(int),
        "peak": np.sqrt(peak) / KP,
        "effort": np.where(is_settled, effort / KP**1.5, math.inf),
        "overshoot": np.degrees(np.where(is_past, overshoot_angle, 0.0)),
    }


EXPERIMENT = Experiment.of(
    globals(),
    "laws on the free body in situations of dimensionless numbers",
    table=read_table(__file__, "settling"),
    units=lambda request: (),
    cost_s=lambda unit: unit.episodes * START_S,
    prepare=lambda request, unit: prepare_law(request, unit, "perturbed", metrics()),
    ticks=lambda request, unit: 3 * MOST * HORIZON_S / 1e-3,
    in_suites=False,
)
