"""One call for every engine: a contender on starts of a task, rows of numbers back."""

import numpy as np

from bench.engines import lanes
from bench.engines.binding import evaluation_of, memory_of, observer, plant_of
from bench.engines.compiled import EVALUATE, compile_function, compile_loop, made_once, own_law
from bench.engines.convergence import Level, at_level, converged
from bench.engines.curve import Curves, blank_curves
from bench.engines.episode import Settings, blank, numbers, start_rows
from bench.engines.plants import ideal
from bench.engines.plants.ideal import REFINED
from bench.law.contender import Contender

CONTINUOUS = "ideal-rk4"
"""The paper's continuous plant."""

NOTHING_IS_GOOD_ENOUGH = -1.0
"""A squared tolerance that no step keeps."""

WORTH_LANES = 100_000
"""Episodes of a law from which on lanes save more than the 3 to 8 s that they take to compile: 50 ns of each of some
1,000 ticks."""


def run(
    engine: str,
    contender: Contender,
    task: str,
    starts,
    settings: Settings,
    metrics,
    integrator: str = "euler",
    curves: Curves | None = None,
    total: int = 0,
    converge: bool = True,
) -> np.ndarray:
    """Rows of `engines.episode`, one per start, on the free body; on an arm: `run_arm.run`.

    Args:
        starts: tasks.Start, in order; metrics: Metric, in the order of their columns.
        curves: filled too, on any engine but `reference`.
        total: episodes of which these are some; converge: see `on_ideal`.
    """
    if engine == "reference":
        from bench.engines.reference import free_body as reference

        return reference.run(contender, task, starts, start_rows(starts)[:, 11], settings, metrics, integrator)
    begun = start_rows(starts)
    if engine != "native":
        return on_ideal(engine, contender, begun, settings, metrics, total, curves, converge)
    import mujoco  # takes a moment; the ideal plant needs none

    from bench.engines.native.libmujoco import model_of
    from bench.engines.plants import free_body

    plant = plant_of(contender, task, settings.gains)
    model = model_of(plant.xml(settings.dt_s), integrator)
    data = mujoco.MjData(model)
    states = np.array([[*qpos, *qvel] for qpos, qvel in map(plant.state, starts)], dtype=float)
    rows, world = blank(len(starts), metrics), free_body.view(model, data, states)
    law, given = law_of(contender, world), (begun, numbers(settings), rows, curves or blank_curves(len(starts)))
    compiled_loop(engine, tuple(metrics))(*law, *given)
    return rows


def law_of(contender: Contender, world=None, orders=None) -> tuple:
    """Return a loop's first arguments: the law, the world it acts in, what else it is to do, and its memory."""
    return evaluation(contender), None, None, world, orders, memory_of(contender)


def on_ideal(
    engine: str,
    contender: Contender,
    begun: np.ndarray,
    settings: Settings,
    metrics=(),
    total: int = 0,
    curves: Curves | None = None,
    converge: bool = True,
) -> np.ndarray:
    """The same on an ideal plant, from starts that are rows already.

    Args:
        begun: of `engines.episode.start_rows`.
        total: episodes that are asked of this law, if these are a part of them; WORTH_LANES of them or more run in
            lanes. The rows are the same bits.
        converge: whether the continuous plant's steps are made shorter where they decide, see `convergence`.
    """
    metrics, curves = tuple(metrics), curves or blank_curves(len(begun))
    if engine != CONTINUOUS or not converge:
        return _once(engine, contender, begun, settings, metrics, total, curves)

    def once(chosen: Settings) -> np.ndarray:
        """Rows of all; only those of the given control period are seen by metrics and curves."""
        if chosen is settings:
            return _once(engine, contender, begun, chosen, metrics, total, curves)
        return _once(engine, contender, begun, chosen, (), total, blank_curves(len(begun)))

    def again(level: Level, which: np.ndarray) -> np.ndarray:
        rows, some = blank(len(which), metrics), Curves(curves.every, np.full_like(curves.samples[which], np.nan))
        limits = at_level(numbers(settings), level)
        compiled_loop(REFINED, metrics)(*law_of(contender), begun[which], limits, rows, some)
        curves.samples[which] = some.samples
        return rows

    return converged(once, again, settings)


def _once(engine, contender, begun, settings, metrics, total, curves) -> np.ndarray:
    rows = blank(len(begun), metrics)
    if curves.samples.shape[1] == 0 and is_in_lanes(max(total, len(begun))):
        loop_in_lanes(engine, contender, metrics)(memory_of(contender), begun, numbers(settings), rows)
    else:
        compiled_loop(engine, metrics)(*law_of(contender), begun, numbers(settings), rows, curves)
    return rows


def by_equal_steps(contender: Contender, begun: np.ndarray, settings: Settings, divisions: int) -> np.ndarray:
    """Rows on the continuous plant by Runge-Kutta steps of a control period over `divisions`, an even number or 1.

    The judge sees the body once a control period, whatever the step.
    """
    if divisions == 1:
        return on_ideal(CONTINUOUS, contender, begun, settings, converge=False)
    rows, limits = blank(len(begun), ()), at_level(numbers(settings), Level(0.0, divisions))
    limits = limits._replace(tolerance_squared=NOTHING_IS_GOOD_ENOUGH, most_steps=divisions * settings.ticks)
    compiled_loop(REFINED, ())(*law_of(contender), begun, limits, rows, blank_curves(len(begun)))
    return rows


def is_in_lanes(total: int) -> bool:
    """Whether so many episodes of a law are worth a loop of its own."""
    return total >= WORTH_LANES


def prepare(engine: str, contender: Contender, metrics, total: int = 0) -> None:
    """Compile what `run` will need for so many episodes, or take it from the disk cache."""
    is_continuous, metrics = engine == CONTINUOUS, tuple(metrics)
    for observed in dict.fromkeys((metrics, () if is_continuous else metrics)):
        if engine.startswith("ideal") and is_in_lanes(total):
            loop_in_lanes(engine, contender, observed)
        else:
            compiled_loop(engine, observed)
            evaluation(contender)
    if is_continuous:
        compiled_loop(REFINED, metrics)
        evaluation(contender)


@made_once
def loop_in_lanes(engine: str, contender: Contender, metrics: tuple):
    """The loop of an ideal plant with a law compiled into it; see `evaluation`."""
    with own_law(contender.regulator.origin) as cache:
        return lanes.episodes_of(engine, evaluation_of(contender), observer(metrics), len(metrics), cache)


@made_once
def compiled_loop(engine: str, metrics: tuple):
    """The loop of an engine, for all laws, compiled or taken from the disk cache."""
    observe = observer(metrics)
    if engine == "native":
        from bench.engines.plants import free_body

        return compile_loop(free_body.loop_of(observe), (EVALUATE,), free_body.VIEW)
    return compile_loop(ideal.loop_of(engine, observe), (EVALUATE,))


@made_once
def evaluation(contender: Contender):
    """A contender as the loops call it, compiled or taken from the disk cache; a user's law is compiled anew.

    Errors:
        BadLaw: a user's law that the compiler cannot take.
    """
    with own_law(contender.regulator.origin) as cache:
        return compile_function(evaluation_of(contender), EVALUATE, cache)
