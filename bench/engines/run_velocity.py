"""One call for robots commanded by velocities: a first-order law on starts of the free body or an arm, rows back."""

import functools
import math
from collections.abc import Callable

import mujoco
import numpy as np

import tasks
from bench.engines import velocity
from bench.engines.binding import memory_of
from bench.engines.compiled import compile_function, made_once
from bench.engines.episode import Settings, numbers, start_rows
from bench.engines.native import arm as native
from bench.engines.native import velocity as on_arm
from bench.engines.native.libmujoco import model_of
from bench.engines.run import evaluation
from bench.engines.run_arm import resolution
from bench.engines.velocity import Pace, blank_rows
from bench.law.contender import Contender
from tasks.velocity import servo

ARM_TASK = "arm-regulation"


def run(
    contender: Contender, limit: Callable, K: float, starts, settings: Settings, arm: str = "", lag_s: float = 0.0
) -> np.ndarray:
    """Rows of `engines.velocity`, one per start.

    Args:
        contender: a velocity law; on an arm with its Jacobian and inverse. K: its gain [1/s].
        starts: tasks.Start, in order, whose omega and joint rates are not used: nothing moves before a command.
        lag_s: time constant of the joints' servos [s]; 0: none. Those of the free body have none.
    """
    rows, begun, given = blank_rows(len(starts)), start_rows(starts), numbers(settings)
    pace = Pace(float(K), *map(float, servo(settings.dt_s, lag_s)))
    law = contender._replace(jacobian=None, inverse=None)
    functions = evaluation(law), limit_of(limit)
    if not arm:
        free_body()(*functions, memory_of(law), begun, pace, given, rows)
        return rows
    model = _model(arm, tasks.arm(arm).xml, settings.dt_s)
    data, (work, kept) = mujoco.MjData(model), native.workspace(tasks.arm(arm).joints)
    unknown = (math.nan,) * 3
    states = np.array([(*one.q, *(one.goal_p or unknown)) for one in starts], dtype=float)
    resolve = resolution(contender.inverse)
    arms()(*functions, resolve, memory_of(law), native.view(model, data), work, states, begun, pace, given, rows)
    del kept  # what the addresses of `work` point into, until here
    return rows


@functools.lru_cache(maxsize=16)
def _model(arm: str, xml: str, dt_s: float) -> mujoco.MjModel:
    """A model that many simulations may share; xml: what the arm's file says now."""
    return model_of(tasks.task(ARM_TASK, arm).xml(dt_s), "euler")


@made_once
def free_body():
    """The loop of the free body."""
    return velocity.episodes_of()


@made_once
def arms():
    """The loop of arms."""
    return on_arm.episodes_of()


@made_once
def limit_of(limit: Callable):
    """A limiter as the loops call it."""
    return compile_function(limit, velocity.LIMIT)


def prepare(contender: Contender, limits) -> None:
    """Compile what `run` will need, or take it from the disk cache."""
    evaluation(contender._replace(jacobian=None, inverse=None))
    for one in limits:
        limit_of(one)
    if contender.inverse:
        resolution(contender.inverse)
        arms()
    else:
        free_body()
