"""One call for every engine: a contender on starts of a task, rows of numbers back."""

import functools
import threading

import mujoco
import numpy as np

import tasks
from bench.contender import Contender
from bench.engines import ideal
from bench.engines.binding import command_of, margin_of, memory_of, observer
from bench.engines.compiled import own_law
from bench.engines.episode import Settings, blank, numbers, start_rows
from bench.engines.native import free_body as native
from bench.engines.reference import free_body as reference

MUJOCO_INTEGRATORS = {
    "euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "rk4": mujoco.mjtIntegrator.mjINT_RK4,
}


def run(
    engine: str, contender: Contender, task: str, starts, settings: Settings, metrics, integrator="euler"
) -> np.ndarray:
    """Rows of `engines.episode`, one per start, on the free body; on an arm: `run_arm.run`.

    Args:
        starts: tasks.Start, in order; metrics: Metric, in the order of their columns.
    """
    if engine == "reference":
        return reference.run(contender, task, starts, start_rows(starts)[:, 11], settings, metrics, integrator)
    rows = blank(len(starts), metrics)
    loop = compiled_loop(engine, contender, tuple(metrics))
    if engine == "native":
        model = mujoco.MjModel.from_xml_string(tasks.task(task).xml(settings.dt_s))
        model.opt.integrator = MUJOCO_INTEGRATORS[integrator]
        data = mujoco.MjData(model)
        states = np.array([[*qpos, *qvel] for qpos, qvel in map(tasks.task(task).state, starts)], dtype=float)
        loop(native.view(model, data), states, start_rows(starts), numbers(settings), rows)
    else:
        loop(start_rows(starts), numbers(settings), rows)
    return rows


_locks: dict = {}


def compiled_loop(engine: str, contender: Contender, metrics: tuple):
    """The loop of a contender, compiled or taken from the disk cache; a user's law is compiled anew each time.

    Threads that need the same loop wait for the first of them, rather than compile it again.

    Errors:
        BadLaw: a user's law that the compiler cannot take.
    """
    with _locks.setdefault((engine, contender), threading.Lock()):
        return _compiled_loop(engine, contender, metrics)


@functools.cache
def _compiled_loop(engine: str, contender: Contender, metrics: tuple):
    parts = command_of(contender), margin_of(contender), observer(metrics), memory_of(contender)
    with own_law(contender.regulator.origin) as cache:
        if engine == "native":
            return native.episodes_of(*parts, cache)
        return ideal.episodes_of(engine, *parts, cache)
