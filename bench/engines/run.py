"""One call for every engine: a contender on starts of a task, rows of numbers back."""

import mujoco
import numpy as np

from bench.engines import ideal
from bench.engines.binding import evaluation_of, memory_of, observer, plant_of
from bench.engines.compiled import EVALUATE, compile_function, made_once, own_law
from bench.engines.curve import Curves, blank_curves
from bench.engines.episode import Settings, blank, numbers, start_rows
from bench.engines.native import free_body as native
from bench.engines.reference import free_body as reference
from bench.law.contender import Contender

MUJOCO_INTEGRATORS = {
    "euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "rk4": mujoco.mjtIntegrator.mjINT_RK4,
}


def run(
    engine: str,
    contender: Contender,
    task: str,
    starts,
    settings: Settings,
    metrics,
    integrator: str = "euler",
    curves: Curves | None = None,
) -> np.ndarray:
    """Rows of `engines.episode`, one per start, on the free body; on an arm: `run_arm.run`.

    Args:
        starts: tasks.Start, in order; metrics: Metric, in the order of their columns.
        curves: filled too, on any engine but `reference`.
    """
    if engine == "reference":
        return reference.run(contender, task, starts, start_rows(starts)[:, 11], settings, metrics, integrator)
    rows = blank(len(starts), metrics)
    loop = compiled_loop(engine, tuple(metrics))
    law = evaluation(contender), memory_of(contender)
    given = start_rows(starts), numbers(settings), rows, curves or blank_curves(len(starts))
    if engine == "native":
        plant = plant_of(contender, task, settings.gains)
        model = mujoco.MjModel.from_xml_string(plant.xml(settings.dt_s))
        model.opt.integrator = MUJOCO_INTEGRATORS[integrator]
        data = mujoco.MjData(model)
        states = np.array([[*qpos, *qvel] for qpos, qvel in map(plant.state, starts)], dtype=float)
        loop(*law, native.view(model, data), states, *given)
    else:
        loop(*law, *given)
    return rows


@made_once
def compiled_loop(engine: str, metrics: tuple):
    """The loop of an engine, for all laws, compiled or taken from the disk cache."""
    observe = observer(metrics)
    return native.episodes_of(observe) if engine == "native" else ideal.episodes_of(engine, observe)


@made_once
def evaluation(contender: Contender):
    """A contender as the loops call it, compiled or taken from the disk cache; a user's law is compiled anew.

    Errors:
        BadLaw: a user's law that the compiler cannot take.
    """
    with own_law(contender.regulator.origin) as cache:
        return compile_function(evaluation_of(contender), EVALUATE, cache)
