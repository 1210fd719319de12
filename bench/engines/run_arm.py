"""One call for both engines of arms: a contender on starts of a task and an arm, rows of numbers back."""

import functools
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.control.resolved_acceleration import assembly
from bench.engines.arm_episode import STANDING, blank_arm, controls, joints, states
from bench.engines.binding import margin_of, memory_of, observer, parts_for
from bench.engines.compiled import compile_function, compile_loop, made_once, own_law
from bench.engines.curve import Curves, blank_curves
from bench.engines.episode import Settings, numbers, start_rows
from bench.engines.native import arm as native
from bench.engines.native.libmujoco import model_of
from bench.engines.plants import arm as on_arm
from bench.engines.plants.arm import Orders, World
from bench.engines.reference import arm as reference
from bench.law.contender import Contender
from tasks.arm_model import Arm

NOMINAL = "nominal"
"""The variation in which the controller's model is the plant."""


class Pointers(NamedTuple):
    """A contender as the compiled loop takes it: three functions of fixed signatures."""

    assemble: object
    resolve: object
    margin: object


class Simulation(NamedTuple):
    """A plant and the controller's model of it, ready for the loop; `kept` holds what the addresses point into."""

    plant: native.ArmView
    model: native.ArmView
    work: native.Workspace
    has_own_model: bool
    kept: tuple


def run(
    engine: str,
    contender: Contender,
    task: str,
    arm: str,
    starts,
    settings: Settings,
    metrics,
    integrator: str = "euler",
    variation: str = NOMINAL,
    curves: Curves | None = None,
) -> np.ndarray:
    """Rows of `engines.arm_episode`, one per start.

    Args:
        starts: tasks.Start with joint angles, in order; metrics: Metric, in the order of their columns.
        variation: how the plant differs from the controller's model. curves: filled too, on the engine `native`.
    """
    if engine == "reference":
        bands = start_rows(starts)[:, 11]
        return reference.run(contender, task, arm, starts, bands, settings, metrics, integrator, variation)
    rows = blank_arm(len(starts), metrics)
    has_one_at_rest = controls(contender, False, 1.0).has_own_model == STANDING
    ready = simulation(task, arm, settings.dt_s, integrator, variation, has_one_at_rest)
    n = tasks.arm(arm).joints
    shape = controls(contender, ready.has_own_model, settings.torque_limit)
    compiled_loop(tuple(metrics))(
        *pointers(contender),
        World(ready.plant, states(starts, n)),
        Orders(ready.model, ready.work, shape, joints(tasks.arm(arm))),
        memory_of(contender),
        start_rows(starts),
        numbers(settings),
        rows,
        curves or blank_curves(len(starts)),
    )
    return rows


def simulation(
    task: str, arm: str, dt_s: float, integrator: str, variation: str = NOMINAL, has_own_model: bool = False
) -> Simulation:
    """The models of one arm: the plant, and the controller's if it is another one or has_own_model."""
    names = (variation, NOMINAL) if has_own_model or variation != NOMINAL else (NOMINAL,)
    models = [_model(task, tasks.arm(arm), dt_s, integrator, name) for name in names]
    datas = [mujoco.MjData(model) for model in models]
    views = [native.view(model, data) for model, data in zip(models, datas, strict=True)]
    work, arrays = native.workspace(tasks.arm(arm).joints)
    return Simulation(views[0], views[-1], work, len(views) > 1, (models, datas, arrays))


@functools.lru_cache(maxsize=64)
def _model(task: str, arm: Arm, dt_s: float, integrator: str, variation: str) -> mujoco.MjModel:
    """A model that many simulations may share: stepping does not change it."""
    model = model_of(tasks.task(task, arm.name).xml(dt_s), integrator)
    if variation != NOMINAL:
        tasks.variation(variation).apply(model, arm.rated)
    return model


@made_once
def compiled_loop(metrics: tuple):
    """The loop with these metrics, for all contenders, compiled or taken from the disk cache."""
    laws = native.ASSEMBLE, native.RESOLVE, on_arm.MARGIN
    return compile_loop(on_arm.loop_of(observer(metrics)), laws, on_arm.WORLD, on_arm.ORDERS)


def pointers(contender: Contender) -> Pointers:
    """The three functions of a contender, compiled or taken from the disk cache; a user's law is compiled anew."""
    law = contender._replace(jacobian=None, inverse=None)
    return Pointers(_assemble(contender._replace(inverse=None)), resolution(contender.inverse), _margin(law))


@made_once
def _assemble(contender: Contender):
    with own_law(contender.regulator.origin) as cache:
        return compile_function(assembly(parts_for(contender)), native.ASSEMBLE, cache)


@made_once
def resolution(inverse):
    """An inverse as loops call it."""
    return compile_function(inverse.resolve, native.RESOLVE)


@made_once
def _margin(contender: Contender):
    return compile_function(margin_of(contender), on_arm.MARGIN)
