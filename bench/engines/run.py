"""One call for every engine: a contender on starts of a task, rows of numbers back."""

import numpy as np

from bench.engines import ideal, lanes
from bench.engines.binding import evaluation_of, memory_of, observer, plant_of
from bench.engines.compiled import EVALUATE, compile_function, made_once, own_law
from bench.engines.curve import Curves, blank_curves
from bench.engines.episode import Settings, blank, numbers, start_rows
from bench.law.contender import Contender

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
) -> np.ndarray:
    """Rows of `engines.episode`, one per start, on the free body; on an arm: `run_arm.run`.

    Args:
        starts: tasks.Start, in order; metrics: Metric, in the order of their columns.
        curves: filled too, on any engine but `reference`.
        total: episodes of which these are some; see `on_ideal`.
    """
    if engine == "reference":
        from bench.engines.reference import free_body as reference

        return reference.run(contender, task, starts, start_rows(starts)[:, 11], settings, metrics, integrator)
    begun = start_rows(starts)
    if engine != "native":
        return on_ideal(engine, contender, begun, settings, metrics, total, curves)
    import mujoco  # takes a moment; the ideal plant needs none

    from bench.engines.native import free_body as native
    from bench.engines.native.libmujoco import model_of

    plant = plant_of(contender, task, settings.gains)
    model = model_of(plant.xml(settings.dt_s), integrator)
    data = mujoco.MjData(model)
    states = np.array([[*qpos, *qvel] for qpos, qvel in map(plant.state, starts)], dtype=float)
    law, rows = (evaluation(contender), memory_of(contender)), blank(len(starts), metrics)
    given = begun, numbers(settings), rows, curves or blank_curves(len(starts))
    compiled_loop(engine, tuple(metrics))(*law, native.view(model, data), states, *given)
    return rows


def on_ideal(
    engine: str,
    contender: Contender,
    begun: np.ndarray,
    settings: Settings,
    metrics=(),
    total: int = 0,
    curves: Curves | None = None,
) -> np.ndarray:
    """The same on an ideal plant, from starts that are rows already.

    Args:
        begun: of `engines.episode.start_rows`.
        total: episodes that are asked of this law, if these are a part of them; WORTH_LANES of them or more run in
            lanes. The rows are the same bits.
    """
    rows = blank(len(begun), metrics)
    if curves is None and is_in_lanes(max(total, len(begun))):
        loop_in_lanes(engine, contender, tuple(metrics))(memory_of(contender), begun, numbers(settings), rows)
    else:
        given = begun, numbers(settings), rows, curves or blank_curves(len(begun))
        compiled_loop(engine, tuple(metrics))(evaluation(contender), memory_of(contender), *given)
    return rows


def is_in_lanes(total: int) -> bool:
    """Whether so many episodes of a law are worth a loop of its own."""
    return total >= WORTH_LANES


def prepare(engine: str, contender: Contender, metrics, total: int = 0) -> None:
    """Compile what `run` will need for so many episodes, or take it from the disk cache."""
    if engine.startswith("ideal") and is_in_lanes(total):
        loop_in_lanes(engine, contender, tuple(metrics))
    else:
        compiled_loop(engine, tuple(metrics))
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
        from bench.engines.native import free_body as native

        return native.episodes_of(observe)
    return ideal.episodes_of(engine, observe)


@made_once
def evaluation(contender: Contender):
    """A contender as the loops call it, compiled or taken from the disk cache; a user's law is compiled anew.

    Errors:
        BadLaw: a user's law that the compiler cannot take.
    """
    with own_law(contender.regulator.origin) as cache:
        return compile_function(evaluation_of(contender), EVALUATE, cache)
