"""Episodes of the live page in node or a browser, and the same by the compiled loop: rows to compare."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from bench.engines.curve import blank_curves
from bench.engines.episode import FINAL_ANGLE, OUTCOME, SETTLING_TICK, TICKS, start_rows
from bench.engines.simulate import run
from bench.engines.simulate_bodies import run_disturbed
from bench.export.subject import find_subject, translated
from bench.law.contenders.registry import find_contender
from support.driving import settings
from tasks.condition import Condition
from tasks.rules import RULES

HORIZON_S, KP, KV = 6.0, 100.0, 20.0
IDEAL = Condition()
"""Asked every millisecond, given the truth at once."""

SEEN = (50, 200)
"""Ticks of 1 ms after which the orientations are compared."""

PLAYED = Path(__file__).with_name("played.js").read_text(encoding="utf-8")
"""JavaScript: a row an episode, (outcome, settling tick, ticks, final angle, R after each of SEEN)."""


class Wanted(NamedTuple):
    """Rows of the compiled loop, as PLAYED has them; R where it was kept."""

    rows: np.ndarray
    states: np.ndarray | None
    is_algebraic: bool


def asked(condition: Condition = IDEAL) -> tuple[dict, dict]:
    """Settings and rules, as the page hands them over."""
    bound = None if np.isinf(condition.bound) else condition.bound
    times = {"period_s": condition.period_s, "delay_s": condition.delay_s, "horizon_s": HORIZON_S}
    worst = condition.worst_attitude_error
    noise = {"attitude_noise": 0.0, "rate_noise": 0.0, "worst_attitude_error": worst}
    given = {"kp": KP, "kv": KV, "bound": bound, "inertia": condition.inertia, **times, **noise}
    return given, {**RULES._asdict(), "slow_squared": RULES.slow_squared}


def by_the_sampled_plant(word: str, starts) -> Wanted:
    """Simulate by the engine `ideal-held`, whose rows are in the results."""
    curves = blank_curves(len(starts), len(range(0, max(SEEN) + 1, SEEN[0])), SEEN[0])
    chosen = settings(horizon_s=HORIZON_S, hold_ticks=RULES.hold_ticks(1e-3))
    rows = run("ideal-held", find_contender(word), "free-body", starts, chosen, (), curves=curves)
    states = curves.samples[:, [tick // SEEN[0] for tick in SEEN], 1:10].reshape(len(starts), -1)
    return Wanted(_judged(rows), states, _is_algebraic(word))


def by_the_perturbed_plant(word: str, starts, condition: Condition) -> Wanted:
    """Simulate by the loop under perturbations."""
    rows = run_disturbed(find_contender(word), starts, condition, settings(horizon_s=HORIZON_S), ())
    return Wanted(_judged(rows), None, _is_algebraic(word) and not condition.worst_attitude_error)  # it turns by libm


def rows_of(starts) -> list[list[float]]:
    """Starts, as the page is given them here."""
    return start_rows(starts).tolist()


def _judged(rows: np.ndarray) -> np.ndarray:
    return rows[:, [OUTCOME, SETTLING_TICK, TICKS, FINAL_ANGLE]]


def _is_algebraic(word: str) -> bool:
    return translated(find_subject(word)).is_algebraic


def differing(wanted: Wanted, found: list) -> list[int]:
    """Numbers of the episodes that end otherwise, or are elsewhere on their way.

    The angle itself is by another atan2; with a law that calls libm orientations may differ by rounding, too.
    """
    rows = np.array(found, dtype=float)
    ends = rows[:, :3] == wanted.rows[:, :3]
    same = ends.all(axis=1) & np.isclose(rows[:, 3], wanted.rows[:, 3], rtol=0.0, atol=1e-6, equal_nan=True)
    if wanted.states is not None:
        states, ran = rows[:, 4:], ~np.isnan(rows[:, 4:])
        off = np.where(ran, np.abs(states - wanted.states), 0.0).max(axis=1)
        same &= off == 0.0 if wanted.is_algebraic else off < 1e-6
    return np.flatnonzero(~same).tolist()


def most_that_rounding_decides(wanted: Wanted) -> int:
    """Return how many episodes rounding may decide: a law that calls libm passes some poles at high speed."""
    return 0 if wanted.is_algebraic else len(wanted.rows) // 20
