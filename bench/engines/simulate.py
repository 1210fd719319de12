"""Episodes of the bodies that turn freely: a contender on starts of a task in any engine, rows of numbers back.

`simulate` runs any loop of `LOOPS`; what a plant needs besides is made here, and for arms in `simulate_arms`.
"""

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from bench.engines import lanes, signatures
from bench.engines.binding import evaluation_of, memory_of, observer, plant_of
from bench.engines.compiled import compile_function, compile_loop, compile_once, own_law
from bench.engines.convergence import Level, at_level, converged
from bench.engines.curve import Curves, blank_curves
from bench.engines.episode import Metrics, Numbers, Settings, Starts, blank, numbers, start_rows
from bench.engines.plants import ideal
from bench.engines.plants.ideal import REFINED
from bench.law.contender import Contender

CONTINUOUS = "ideal-rk4"
"""The paper's continuous plant."""

WORTH_LANES = 100_000
"""Episodes of a law from which on lanes save more than the 3 to 8 s that they take to compile: 50 ns of each of some
1,000 ticks."""

LOOPS = {
    "native": ("free_body", "loop_of", (signatures.EVALUATE,), "FreeBodyWorld"),
    "perturbed": ("perturbed", "loop_of", (signatures.EVALUATE,), "PerturbedWorld"),
    "stream": ("quaternion", "streamed", (signatures.EVALUATE,), "SentGoals"),
    "state": ("quaternion", "with_state", (signatures.STATEFUL, signatures.BEGIN_STATE), "Disturbance"),
    "velocity": ("velocity", "of_body", (signatures.EVALUATE, signatures.LIMIT), "Pace"),
    "velocity-arm": (
        "velocity",
        "of_arm",
        (signatures.EVALUATE, signatures.LIMIT, signatures.RESOLVE),
        "VelocityWorld",
    ),
    "arm": ("arm", "loop_of", (signatures.ASSEMBLE, signatures.RESOLVE, signatures.MARGIN), "ArmWorld"),
    "impedance": ("impedance", "of_arm", (signatures.EVALUATE, signatures.DESIGN), "ImpedanceWorld"),
    "contact": ("contact", "loop", (signatures.TOUCH,), "ContactWorld"),
}
"""Beside the ideal ones: the file in `plants`, what makes the loop (`loop_of` of the metrics), the signatures of the
functions that it calls, and its world."""


@compile_once
def compiled_loop(kind: str, metrics: tuple = ()) -> Callable:
    """Return a loop, for all laws, compiled or taken from the disk cache."""
    if kind in ideal.STEPS:
        return compile_loop(ideal.loop_of(kind, observer(metrics)), (signatures.EVALUATE,))
    file, make, laws, world = LOOPS[kind]
    plant = importlib.import_module(f"bench.engines.plants.{file}")  # MuJoCo takes a moment; the ideal plants need none
    made = getattr(plant, make)(*[observer(metrics)] * (make == "loop_of"))
    return compile_loop(made, laws, getattr(plant, world))


def simulate(
    loop: Callable, laws: tuple, world: Any, memory: tuple, begun: np.ndarray, limits: Numbers, rows: np.ndarray,
    curves: Curves | None = None,
) -> np.ndarray:  # fmt: skip
    """Run a loop, of `compiled_loop` or plain: fill a row, and a curve if there is room, for each start.

    laws: the functions that it calls. world: what its plant and controller work in. begun: of `episode.start_rows`.
    """
    functions = (*laws, *[None] * (3 - len(laws)))
    loop(*functions, world, memory, begun, limits, rows, curves or blank_curves(len(begun)))
    return rows


def run(
    engine: str, contender: Contender, task: str, starts: Starts, settings: Settings, metrics: Metrics,
    integrator: str = "euler", curves: Curves | None = None, total: int = 0, converge: bool = True,
) -> np.ndarray:  # fmt: skip
    """Return rows of `engines.episode`, one per start, on the free body; on an arm: `simulate_arms.run_arm`.

    metrics: in the order of their columns. curves: filled too, on any engine but `reference`. total: episodes of which
    these are some; converge: see `on_ideal`.
    """
    if engine == "reference":
        from bench.engines import reference

        return reference.run(contender, task, starts, settings, metrics, integrator)
    begun = start_rows(starts)
    if engine != "native":
        return on_ideal(engine, contender, begun, settings, metrics, total, curves, converge)
    import mujoco

    from bench.engines.mujoco_view import compiled_view
    from bench.engines.native.libmujoco import model_of, skip_constraints
    from bench.engines.plants import free_body

    plant = plant_of(contender, task, settings.gains)
    model = skip_constraints(model_of(plant.xml(settings.dt_s), integrator))
    data = mujoco.MjData(model)
    states = np.array([[*qpos, *qvel] for qpos, qvel in map(plant.state, starts)], dtype=float)
    world = free_body.FreeBodyWorld(
        compiled_view(model, data), int(contender.regulator.in_engine), states
    )
    law, rows = (evaluation(contender),), blank(len(starts), metrics)
    loop = compiled_loop(engine, tuple(metrics))
    return simulate(loop, law, world, memory_of(contender), begun, numbers(settings), rows, curves)


def on_ideal(
    engine: str,
    contender: Contender,
    begun: np.ndarray,
    settings: Settings,
    metrics: Metrics = (),
    total: int = 0,
    curves: Curves | None = None,
    converge: bool = True,
) -> np.ndarray:
    """Simulate on an ideal plant, from starts that are rows already (`engines.episode.start_rows`).

    total: number of episodes of this law, if these are a part of them; from WORTH_LANES on they run in lanes.
    The rows are the same bits. converge: whether the continuous plant's steps are made shorter where they decide.
    """
    metrics, curves = tuple(metrics), curves or blank_curves(len(begun))

    def once(chosen: Settings) -> np.ndarray:
        """Rows of all; only those of the given control period are seen by metrics and curves."""
        seen, kept = (metrics, curves) if chosen is settings else ((), blank_curves(len(begun)))
        if kept.samples.shape[1] or max(total, len(begun)) < WORTH_LANES:
            return by_law(engine, contender, begun, numbers(chosen), seen, kept)
        rows = blank(len(begun), seen)
        loop_in_lanes(engine, contender, seen)(memory_of(contender), begun, numbers(chosen), rows)
        return rows

    if engine != CONTINUOUS or not converge:
        return once(settings)

    def again(level: Level, which: np.ndarray) -> np.ndarray:
        some = Curves(curves.every, np.full_like(curves.samples[which], np.nan))
        rows = by_law(REFINED, contender, begun[which], at_level(numbers(settings), level), metrics, some)
        curves.samples[which] = some.samples
        return rows

    return converged(once, again, settings)


def by_law(
    engine: str,
    contender: Contender,
    begun: np.ndarray,
    limits: Numbers,
    metrics: tuple = (),
    curves: Curves | None = None,
    memory: tuple | None = None,
) -> np.ndarray:
    """Run the loop of an ideal plant, one start at a time; memory: another than the law's own."""
    law, loop, rows = (evaluation(contender),), compiled_loop(engine, metrics), blank(len(begun), metrics)
    return simulate(loop, law, None, memory or memory_of(contender), begun, limits, rows, curves)


def prepare(engine: str, contender: Contender, metrics: Metrics, total: int = 0) -> None:
    """Compile what `run` will need for so many episodes, or take it from the disk cache."""
    is_continuous, metrics = engine == CONTINUOUS, tuple(metrics)
    for observed in dict.fromkeys((metrics, () if is_continuous else metrics)):
        if engine.startswith("ideal") and total >= WORTH_LANES:
            loop_in_lanes(engine, contender, observed)
        else:
            compiled_loop(engine, observed)
            evaluation(contender)
    if is_continuous:
        compiled_loop(REFINED, metrics)
        evaluation(contender)


@compile_once
def loop_in_lanes(engine: str, contender: Contender, metrics: tuple) -> Callable:
    """Return the loop of an ideal plant with a law compiled into it; see `evaluation`."""
    with own_law(contender.regulator.origin) as cache:
        return lanes.episodes_of(engine, evaluation_of(contender), observer(metrics), len(metrics), cache)


@compile_once
def evaluation(contender: Contender) -> Callable:
    """Compile a contender for the loops, or take it from the disk cache; a user's law is compiled every time."""
    with own_law(contender.regulator.origin) as cache:
        return compile_function(evaluation_of(contender), signatures.EVALUATE, cache)
