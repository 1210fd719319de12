"""Episodes as curves: the state every few ticks, for figures and for claims about a whole response.

Of the paper's laws and a user's own, on the free body: the `paper` starts and some uniform ones. On arms claims ask for
curves of theirs (`of_arm`), which no run keeps.
"""

from __future__ import annotations

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.engines.curve import ARM_NUMBERS, NUMBERS, blank_curves
from bench.experiments import free_body
from bench.experiments.columns import read_table
from bench.experiments.episode_rows import judged_columns
from bench.experiments.episodes import prepare, simulate
from bench.experiments.experiment import OF_LAWS, Experiment, Unit, user_laws_last
from bench.experiments.request import Request
from bench.experiments.starts import on_arm
from bench.experiments.suites import HORIZON, LONG, SHORT
from bench.law.contender import Contender

EVERY_S = 0.02
"""Five samples in each time constant of 0.1 s."""

LONGEST_S = 4.0
SAMPLES = round(LONGEST_S / EVERY_S)

CURVE_S = 0.05
"""CPU seconds a curve; most of it goes into its rows."""


TABLE = read_table(__file__, "traces")


def laws(request: Request) -> list[Contender]:
    """Return the laws that are run on the free body."""
    names = {unit.contender for unit in free_body.units(request)}
    return [one for one in request.laws if one.name in names]


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit a law on the free body, continuous but for MuJoCo's own actuator; a user's last."""
    count = request.section("traces")["uniform"]
    followed = [one for one in laws(request) if count and not one.is_beyond_the_paper]
    return user_laws_last([of_law(one, count) for one in followed], request)


def of_law(one: Contender, count: int) -> Unit:
    """Return the unit of a law on the free body, from so many uniform starts beside the others."""
    engine = "native" if one.regulator.in_engine else "ideal-rk4"
    return Unit("traces", one.name, "free-body", engine=engine, count=count, horizon_s=LONG)


def of_arm(contender: str, task: str, arm: str, count: int, start_set: str) -> Unit:
    """Return the unit of a controller on an arm, from the first so many of a start set."""
    return Unit("traces", contender, task, arm, "native", start_set, count=count, horizon_s=LONGEST_S)


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return the samples of all curves of a unit."""
    every = max(1, round(EVERY_S / request.dt_s))
    sets = ((unit.selector, unit.count),) if unit.arm else (("paper", None), ("uniform", unit.count))
    place = {"task": unit.task, "arm": unit.arm, **request.contender(unit.contender).words}
    frames = []
    for name, count in sets:
        starts = (on_arm if unit.arm else tasks.start_set)(name, count, request.seed, unit.arm)
        names = ARM_NUMBERS if unit.arm else NUMBERS
        curves = blank_curves(len(starts), SAMPLES, every, names)
        made = simulate(request, unit, starts, unit.horizon_s if unit.arm else HORIZON.get(name, SHORT), curves)
        endings = {"outcome": [""] * len(starts)} if unit.arm else judged_columns(made, request.dt_s)
        whose = {**place, "engine": unit.engine, "start_set": name}
        is_kept = ~np.isnan(curves.samples[:, :, 0])
        lengths = is_kept.sum(axis=1)
        found = dict(zip(names, curves.samples[is_kept].T, strict=True))
        found["angle_rad"] = 2.0 * np.arcsin(np.minimum(1.0, np.sqrt(found.pop("haversine"))))
        ids = np.repeat([start.id for start in starts], lengths)
        said = {name: np.repeat(values, lengths) for name, values in endings.items()}  # at all samples of an episode
        frames.append(pd.DataFrame({**whose, "start_id": ids, **found, **said}))
    return pd.concat(frames, ignore_index=True).reindex(columns=TABLE.names)


def is_whole(request: Request, unit: Unit, rows: pd.DataFrame) -> bool:
    """Tell whether rows are samples of the curves of a unit on the free body."""
    names = ("paper", None), ("uniform", unit.count)
    known = {(name, one.id) for name, count in names for one in tasks.start_set(name, count, request.seed)}
    return {*zip(rows["start_set"], rows["start_id"], strict=True)} == known


def curves_of(unit: Unit) -> int:
    """Return how many curves a unit has at most."""
    return unit.count if unit.arm else len(tasks.start_set("paper")) + unit.count


EXPERIMENT = Experiment.of(
    globals(),
    "curves of the paper's laws",
    table=TABLE,
    takes=OF_LAWS,
    prepare=prepare,
    cost_s=lambda unit: CURVE_S * curves_of(unit),
    ticks=lambda request, unit: curves_of(unit) * unit.horizon_s / request.dt_s,
)
