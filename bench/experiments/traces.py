"""Episodes as curves: the state every few ticks, for figures and for claims about a whole response.

On the free body, of every law: the `paper` starts, some uniform ones and those of TELLING. Claims measure the paper's
laws on the first two, to the last digit; every other curve is there to be drawn, to KEPT_BITS.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

import tasks
from bench.experiments import arm, free_body, robustness
from bench.experiments.episodes import prepare
from bench.experiments.experiment import Asked, Experiment, Settings, Unit, own_last
from bench.experiments.starts import on_arm
from bench.experiments.suites import HORIZON, LONG, SHORT
from bench.law.contender import Contender
from bench.tables.schema import TABLES

if TYPE_CHECKING:
    import pandas as pd

EVERY_S = 0.02
"""Five samples in each time constant of 0.1 s."""

LONGEST_S = 4.0
SAMPLES = round(LONGEST_S / EVERY_S)

KEPT_BITS = 22
"""Of a mantissa, 31 bits of it zero: half the bytes, and steps of 5e-7 that `bench compare` does not see."""

FEW = 3
"""Uniform starts of a later law."""

TELLING = {
    "half-turn": ("half-turn-random0-k02", "half-turn-random0-k04", "half-turn-random0-exact", "half-turn-x-exact"),
    "poles": ("pole-plus-k02-a2.5-g2.8", "pole-plus-exact-twist-plus-1.0"),
    "wraps": ("wrap-gamma-plus-k02-b-0.9-o-1.5",),
    "goals": ("goal-beyond-wrap-gamma-up", "goal-uniform-0000"),
    "tumbling": ("tumbling-0002", "tumbling-0006"),
}
"""Start set -> the starts at which laws part.

Short of half a turn by 0.6 and 0.006 degrees, and exactly there; beside and on a pole of Z-Y-X angles; before a jump of
gamma; a goal beyond that jump, and one far from zero; spinning at 11 and at 20 rad/s.
"""

ARM_SETS = ("clear", "pole")
"""Start sets of arms whose first episodes are kept."""


CURVE_S = 0.05
"""CPU seconds a curve; most of it goes into its rows."""


def laws(asked: Asked) -> list[Contender]:
    """The laws that are run on the free body, undisturbed or not."""
    names = {unit.contender for unit in (*free_body.units(asked), *robustness.units(asked))}
    return [one for one in asked.laws if one.name in names]


def units(asked: Asked) -> tuple[Unit, ...]:
    """A unit a law on the free body, then one for each arm and controller on it; a user's last.

    On the free body, continuous but for MuJoCo's own actuator, the starts above; of the paper's laws and the user's the
    suite's number of uniform ones. On arms the first so many of each of ARM_SETS.
    """
    if asked.choice.narrows:
        return ()
    on_arms = dict.fromkeys(
        (unit.contender, unit.task, unit.arm) for unit in arm.units(asked) if unit.selector in ARM_SETS
    )
    several, few = asked.suite.traces, asked.suite.on_arms.traced
    found = [of_law(one, several) for one in laws(asked) if several] + [of_arm(*one, few) for one in on_arms if few]
    return own_last(found, asked.own)


def of_law(one: Contender, count: int) -> Unit:
    """The unit of a law on the free body, from so many uniform starts beside the others."""
    engine = "native" if one.regulator.in_engine else "ideal-rk4"
    return Unit("traces", one.name, "free-body", engine=engine, count=count, horizon_s=LONG)


def of_arm(contender: str, task: str, arm: str, count: int, start_set: str = "") -> Unit:
    """The unit of a controller on an arm, from the first so many of one start set, or of each of ARM_SETS."""
    return Unit("traces", contender, task, arm, "native", start_set, count=count, horizon_s=LONGEST_S)


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The samples of all curves of a unit."""
    import pandas as pd

    every = max(1, round(EVERY_S / settings.dt_s))
    frames = (_on_arm if unit.arm else _on_free_body)(settings, unit, settings.contender(unit.contender), every)
    return pd.concat(list(frames), ignore_index=True).reindex(columns=TABLES["traces"].names)


def _on_free_body(settings: Settings, unit: Unit, one: Contender, every: int) -> Iterator[pd.DataFrame]:
    from bench.engines.curve import NUMBERS, blank_curves
    from bench.engines.run import run
    from bench.experiments.rows.episodes import contender_columns, judged_columns
    from bench.metrics.registry import metrics_of

    metrics = metrics_of(on_arm=False)
    place = {"task": unit.task, "arm": "", **contender_columns(one), "engine": unit.engine}
    for start_set, starts, is_measured in _starts(settings, unit, one):
        curves = blank_curves(len(starts), SAMPLES, every)
        limits = settings.limits(HORIZON.get(start_set, SHORT))
        given = (unit.engine, one, unit.task, starts, limits, metrics, settings.integrator, curves)
        endings = judged_columns(run(*given), settings.dt_s)
        frame = _frame({**place, "start_set": start_set}, starts, curves.samples, NUMBERS, endings)
        yield frame if is_measured else _to_draw(frame, [*NUMBERS[1:-1], "angle_rad"])


def _starts(settings: Settings, unit: Unit, one: Contender):
    """(start set, starts, whether claims measure the curves) of a law."""
    is_papers = not one.is_beyond_the_paper
    yield "paper", tasks.start_set("paper"), is_papers
    yield "uniform", tasks.start_set("uniform", unit.count if is_papers else FEW, settings.seed), is_papers
    for start_set, ids in TELLING.items():
        yield start_set, [start for start in tasks.start_set(start_set, None, settings.seed) if start.id in ids], False


def _on_arm(settings: Settings, unit: Unit, one: Contender, every: int) -> Iterator[pd.DataFrame]:
    from bench.engines.curve import ARM_NUMBERS, blank_curves
    from bench.engines.run_arm import run
    from bench.experiments.rows.episodes import contender_columns
    from bench.metrics.registry import metrics_of

    metrics, limits = metrics_of(on_arm=True), settings.limits(unit.horizon_s)
    place = {"task": unit.task, "arm": unit.arm, **contender_columns(one), "engine": unit.engine}
    for start_set in [unit.selector] if unit.selector else ARM_SETS:
        starts = on_arm(start_set, unit.count, settings.seed, unit.arm)
        curves = blank_curves(len(starts), SAMPLES, every, ARM_NUMBERS)
        run(unit.engine, one, unit.task, unit.arm, starts, limits, metrics, settings.integrator, curves=curves)
        endings = {"outcome": [""] * len(starts)}
        yield _frame({**place, "start_set": start_set}, starts, curves.samples, ARM_NUMBERS, endings)


def _frame(place: dict, starts, samples: np.ndarray, names, endings: dict) -> pd.DataFrame:
    """The curves of all starts, one below the other; what the judge says of an episode stands at all its samples."""
    import pandas as pd

    is_kept = ~np.isnan(samples[:, :, 0])
    lengths = is_kept.sum(axis=1)
    columns = dict(zip(names, samples[is_kept].T, strict=True))
    columns["angle_rad"] = 2.0 * np.arcsin(np.minimum(1.0, np.sqrt(columns.pop("haversine"))))
    said = {name: np.repeat(values, lengths) for name, values in endings.items()}
    return pd.DataFrame({**place, "start_id": np.repeat([start.id for start in starts], lengths), **columns, **said})


def _to_draw(frame: pd.DataFrame, names: list[str]) -> pd.DataFrame:
    """The frame with these columns to KEPT_BITS."""
    mantissa, exponent = np.frexp(frame[names].to_numpy())
    frame[names] = np.ldexp(np.rint(np.ldexp(mantissa, KEPT_BITS)), exponent - KEPT_BITS)
    return frame


def curves_of(unit: Unit) -> int:
    """How many curves a unit has at most."""
    if unit.arm:
        return len(ARM_SETS) * unit.count
    return len(tasks.start_set("paper")) + unit.count + sum(map(len, TELLING.values()))


EXPERIMENT = Experiment(
    "traces",
    "curves of telling episodes",
    TABLES["traces"],
    units,
    rows,
    cost_s=lambda unit: CURVE_S * curves_of(unit),
    prepare=prepare,
    ticks=lambda settings, unit: curves_of(unit) * unit.horizon_s / settings.dt_s,
)
