"""Laws of the free body under perturbations (tasks/conditions): a unit a law and perturbation."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.engines.episode import Settings as Limits
from bench.engines.episode import blank
from bench.engines.metrics.registry import metrics_of
from bench.experiments.columns import SINGLE, of_metrics, read_table
from bench.experiments.episode_rows import episode_columns, lost_numbers, measured_columns
from bench.experiments.episodes import prepare_law
from bench.experiments.experiment import OF_LAWS, Experiment, Unit
from bench.experiments.request import Request
from bench.experiments.suites import BOUNDED
from bench.law.contender import Contender
from bench.law.contenders.registry import papers_laws
from tasks.condition import Condition, condition_at

HORIZON_S = 5.0
"""Longest simulated time [s]: eight settling times of a small error, and a tail to average over."""

SHORTEST_S = 1e-4
"""Control period at the highest rate."""

EPISODE_S = 6e-4
"""CPU seconds an episode, see `free_body`."""


@functools.lru_cache(maxsize=8)
def units(request: Request) -> tuple[Unit, ...]:
    """Return the units of a suite's part, `count` starts a level; Incompatible if no law can meet what is named."""
    if request.tasks and "free-body" not in request.tasks:
        return ()
    section = request.section("robustness")
    contenders = [one for one in request.laws if _takes_part(one, section, request)]
    if request.axes and not contenders:
        usual = papers_laws()[0].name
        raise Incompatible(f"nothing to run: along an axis go laws of the free body (try: --regulator {usual})")
    axes = [tasks.axis(name) for name in request.axes or tasks.axis_names()]
    count = request.count or section["starts"]
    found = []
    for one in contenders:
        for axis in axes:
            if _may_differ(one, axis.name, section, request):
                unit = Unit(
                    "robustness",
                    one.name,
                    selector=axis.name,
                    count=count,
                    total=count,
                    episodes=count * len(axis.levels),
                    horizon_s=request.horizon_s or HORIZON_S,
                )
                found.append(unit)
    return tuple(found)


def _may_differ(one: Contender, axis: str, section: Mapping[str, Any], request: Request) -> bool:
    """Return whether a law may differ along an axis from another law that runs there, or is named by the user."""
    if request.axes or request.regulators or one.regulator.origin:
        return True
    bounded = section["bounded"]
    return not bounded or one.name not in BOUNDED or axis in bounded


def _takes_part(one: Contender, section: Mapping[str, Any], request: Request) -> bool:
    """Tell whether it is a law on R or on the paper's coordinates, a user's, or named; and no actuator of MuJoCo's."""
    is_wanted = bool(one.regulator.origin) or request.names_laws
    is_usual = not one.uses_nonpaper_coordinates or section["others"] is None or one.name in section["others"]
    return (is_wanted or is_usual) and not one.regulator.in_engine


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return one row a level and start."""
    from bench.engines.simulate_bodies import run_disturbed as run

    return simulated(request, unit, run)


def simulated(request: Request, unit: Unit, simulate: Callable) -> pd.DataFrame:
    """Return one row a level and start, simulated as by `run_disturbed`; every law has the same starts and noise."""
    one, axis, seed = request.contender(unit.contender), tasks.axis(unit.selector), request.seed
    metrics, parts = metrics_of(on_arm=False), []
    # the judge's rules in ticks of a microsecond, which the condition's own steps replace
    limits = Limits(request.gains, 1e-6, round(1e6 * unit.horizon_s), 1)
    for level in axis.levels:
        condition, some = condition_at(axis, level), axis.starts(unit.count, seed, level)
        rows = _rows(request, some, condition, limits, simulate(one, some, condition, limits, metrics, seed))
        parts.append(pd.DataFrame({"axis": axis.name, "level": level, **rows}))
    words = {name: one.words[name] for name in ("regulator", "representation")}
    return pd.concat(parts, ignore_index=True).assign(**words)


def lost(request: Request, unit: Unit, outcome: str) -> pd.DataFrame:
    """Return rows with the numbers of the request and the outcome, and no measure."""
    from bench.engines.plants.perturbed import EXTRA

    def simulate(_one: Contender, starts: list, _condition: Condition, _limits: Limits, metrics: tuple, _: int) -> Any:
        return lost_numbers(blank(len(starts), metrics, (0.0,) * EXTRA), outcome)

    nothing = dict.fromkeys((metric.column for metric in metrics_of(on_arm=False)), np.nan)
    return simulated(request, unit, simulate).assign(**nothing, variation=np.nan, judged_rad=np.nan)


def is_whole(request: Request, unit: Unit, rows: pd.DataFrame) -> bool:
    """Tell whether every level is there."""
    return set(tasks.axis(unit.selector).levels) <= set(rows["level"])


def _rows(request: Request, starts: list, condition: Condition, limits: Limits, numbers: np.ndarray) -> dict:
    from bench.engines.plants import perturbed

    step_s = condition.period_s / perturbed.steps_of(condition)
    ran = episode_columns(request, starts, numbers, step_s, limits.ticks * limits.dt_s)
    finals = ran["final_angle_rad"]
    extra = numbers[:, -perturbed.EXTRA :]
    jumped = extra[:, perturbed.JUMPED]
    judged = ran | {"angle0_rad": np.where(jumped > 0.0, jumped, ran["angle0_rad"])}
    tail = extra[:, perturbed.TAIL_COUNT]
    has_tail = tail > 0
    rms = np.sqrt(extra[:, perturbed.TAIL_SQUARES] / np.where(has_tail, tail, 1.0))
    return {
        **ran,
        "kp": limits.gains.kp,
        "kv": limits.gains.kv,
        "dt_s": condition.period_s,
        **measured_columns(numbers, metrics_of(on_arm=False), judged),
        "tail_rms_rad": np.where(has_tail, rms, finals),
        "tail_max_rad": np.where(has_tail, extra[:, perturbed.TAIL_WORST], finals),
        "variation": extra[:, perturbed.VARIATION],
        "judged_rad": judged["angle0_rad"],
    }


EXPERIMENT = Experiment.of(
    globals(),
    "laws on the free body under perturbations",
    table=read_table(__file__, "robustness", METRICS=lambda: of_metrics(metrics_of(on_arm=False), SINGLE)),
    takes=(*OF_LAWS, "axes"),
    cost_s=lambda unit: unit.episodes * EPISODE_S,
    prepare=lambda request, unit: prepare_law(request, unit, "perturbed", metrics_of(on_arm=False)),
    ticks=lambda request, unit: unit.episodes * unit.horizon_s / SHORTEST_S,
    rank=3,
)
