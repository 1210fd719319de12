"""One call for robots commanded by velocities: a first-order law on starts of the free body or an arm, rows back."""

import functools

import mujoco
import numpy as np

import tasks
from bench.engines.arm_episode import states
from bench.engines.binding import memory_of
from bench.engines.compiled import compile_function, made_once
from bench.engines.curve import blank_curves
from bench.engines.episode import Settings, numbers, start_rows
from bench.engines.native import arm as native
from bench.engines.native.libmujoco import model_of
from bench.engines.plants import velocity
from bench.engines.plants.arm import World
from bench.engines.plants.velocity import Orders, Pace, blank_rows
from bench.engines.run import evaluation
from bench.engines.run_arm import resolution
from bench.law.contender import Contender
from bench.law.limiter import Limiter
from tasks.velocity import servo

ARM_TASK = "arm-regulation"


def run(
    contender: Contender, limiter: Limiter, K: float, starts, settings: Settings, arm: str = "", lag_s: float = 0.0
) -> np.ndarray:
    """Rows of `engines.velocity`, one per start.

    Args:
        contender: a velocity law; on an arm with its Jacobian and inverse. K: its gain [1/s].
        starts: tasks.Start, in order, whose omega and joint rates are not used: nothing moves before a command.
        lag_s: time constant of the joints' servos [s]; 0: none. Those of the free body have none.
    """
    rows, none = blank_rows(len(starts), bool(arm)), blank_curves(len(starts))
    pace = Pace(float(K), *map(float, servo(settings.dt_s, lag_s)))
    law = contender._replace(jacobian=None, inverse=None)
    given = memory_of(law), start_rows(starts), numbers(settings), rows, none
    functions = evaluation(law), limit_of(limiter)
    if not arm:
        free_body()(*functions, None, None, pace, *given)
        return rows
    model, n = _model(arm, tasks.arm(arm).xml, settings.dt_s), tasks.arm(arm).joints
    data, (work, kept) = mujoco.MjData(model), native.workspace(n)
    still = states([one._replace(qdot=(0.0,) * n) for one in starts], n)
    arms()(
        *functions, resolution(contender.inverse), World(native.view(model, data), still), Orders(pace, work), *given
    )
    del kept  # what the addresses of `work` point into, until here
    return rows


@functools.lru_cache(maxsize=16)
def _model(arm: str, xml: str, dt_s: float) -> mujoco.MjModel:
    """A model that many simulations may share; xml: what the arm's file says now."""
    return model_of(tasks.task(ARM_TASK, arm).xml(dt_s), "euler")


free_body, arms = made_once(velocity.compile_body), made_once(velocity.compile_arm)


@made_once
def limit_of(limiter: Limiter):
    """A limiter as the loops call it."""
    return compile_function(limiter.limit, velocity.LIMIT)


def prepare(contender: Contender, limiters) -> None:
    """Compile what `run` will need, or take it from the disk cache."""
    evaluation(contender._replace(jacobian=None, inverse=None))
    for one in limiters:
        limit_of(one)
    if contender.inverse:
        resolution(contender.inverse)
        arms()
    else:
        free_body()
