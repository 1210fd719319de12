"""Find where a law first fails along geodesics from the goal: a scan for the first failing angle, then bisection.

A scan misses a failing set of measure zero (180°, a pole): the directed start sets hit those exactly.
"""

from __future__ import annotations

import math

import numpy as np

from bench.base.on_first_use import pd
from bench.engines.episode import OUTCOME, start_rows
from bench.experiments.episodes import prepare, simulate
from bench.experiments.experiment import OF_LAWS, Experiment, Unit, user_laws_last
from bench.experiments.request import Request
from bench.experiments.suites import SHORT
from bench.experiments.traces import laws
from bench.law.contender import Contender
from tasks.base import Start
from tasks.haar import axes
from tasks.verdict import OUTCOMES, SETTLED

SCAN = np.radians(np.arange(2.5, 178.0, 2.5))
BISECTIONS = 10
"""2.5 degrees halved 10 times: 4e-5 rad, a hundredth of the degree that is shown."""

AXIS_S = 0.02
"""CPU seconds an axis."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit for each of the paper's laws, and the user's, over the suite's axes; a user's last."""
    count = request.section("boundaries")["axes"]
    found = [of_law(one, count) for one in laws(request) if count and not one.is_beyond_the_paper]
    return user_laws_last(found, request)


def of_law(one: Contender, count: int) -> Unit:
    """Return the unit of a law, along so many axes."""
    return Unit("boundaries", one.name, "free-body", engine="ideal-rk4", count=count, total=count, horizon_s=SHORT)


def rows(request: Request, unit: Unit) -> dict:
    """Return one row an axis, as columns; where divided steps change an end, they search the whole axis again."""
    directions = axes(unit.count)
    settled, fails, outcome = _search(request, unit, directions, converge=False)
    is_end = ~np.isnan(fails)
    sure = np.full(unit.count, SETTLED)
    sure[is_end] = _outcomes(request, unit, directions[is_end], fails[is_end])
    again = (sure != outcome) | (_outcomes(request, unit, directions, settled) != SETTLED)
    if again.any():
        settled[again], fails[again], outcome[again] = _search(request, unit, directions[again])
    return {
        **request.contender(unit.contender).words,
        **{f"axis_{axis}": directions[:, i] for i, axis in enumerate("xyz")},
        "settled_to_rad": settled,
        "fails_from_rad": fails,
        "outcome": [OUTCOMES[code] if code != SETTLED else "" for code in outcome],
    }


def _search(
    request: Request, unit: Unit, directions: np.ndarray, converge: bool = True
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return of each axis the greatest angle that settles, the least that fails [rad], NaN if none does, and how."""
    count = len(directions)
    first = np.full(count, len(SCAN))
    outcome = np.full(count, SETTLED)
    for place, angle in enumerate(SCAN):
        searching = np.flatnonzero(first == len(SCAN))
        if not len(searching):
            break
        codes = _outcomes(request, unit, directions[searching], np.full(len(searching), angle), converge)
        failed = searching[codes != SETTLED]
        first[failed], outcome[failed] = place, codes[codes != SETTLED]
    settled = np.where(first > 0, SCAN[np.minimum(first, len(SCAN)) - 1], 0.0)
    fails = np.where(first < len(SCAN), SCAN[np.minimum(first, len(SCAN) - 1)], np.nan)
    found = np.flatnonzero(first < len(SCAN))
    for _ in range(BISECTIONS if len(found) else 0):
        middle = 0.5 * (settled[found] + fails[found])
        codes = _outcomes(request, unit, directions[found], middle, converge)
        good = codes == SETTLED
        settled[found[good]] = middle[good]
        fails[found[~good]], outcome[found[~good]] = middle[~good], codes[~good]
    return settled, fails, outcome


def _outcomes(
    request: Request, unit: Unit, directions: np.ndarray, angles: np.ndarray, converge: bool = True
) -> np.ndarray:
    """Return the outcome from each start; nothing else is measured."""
    from bench.engines.simulate import on_ideal

    starts = [
        Start("", (math.cos(angle / 2), *(math.sin(angle / 2) * axis).tolist()))
        for axis, angle in zip(directions, angles, strict=True)
    ]
    if converge:
        return simulate(request, unit, starts, unit.horizon_s)[:, OUTCOME].astype(int)
    one, limits = request.contender(unit.contender), request.limits(unit.horizon_s)
    return on_ideal(unit.engine, one, start_rows(starts), limits, converge=False)[:, OUTCOME].astype(int)


def is_whole(request: Request, unit: Unit, rows: pd.DataFrame) -> bool:
    """Tell whether there is a row for each axis, in order."""
    return np.array_equal(rows[["axis_x", "axis_y", "axis_z"]], axes(unit.count))


EXPERIMENT = Experiment.of(
    globals(),
    "where a law first fails, along geodesics",
    takes=OF_LAWS,
    prepare=prepare,
    cost_s=lambda unit: unit.count * AXIS_S,
    ticks=lambda request, unit: unit.count * len(SCAN) * unit.horizon_s / request.dt_s,
)
