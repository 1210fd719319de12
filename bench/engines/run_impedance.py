"""One call for impedances that shape no inertia: a law's error, springs and a design of damping on starts of an arm."""

import functools

import mujoco
import numpy as np

import tasks
from bench.engines.arm_episode import MOST, states
from bench.engines.binding import memory_of
from bench.engines.compiled import compile_function, made_once
from bench.engines.curve import blank_curves
from bench.engines.episode import Settings, numbers, start_rows
from bench.engines.native import arm as native
from bench.engines.native.libmujoco import model_of
from bench.engines.native.pointers import address_of
from bench.engines.plants import impedance
from bench.engines.plants.arm import World
from bench.engines.plants.impedance import Orders, Springs, blank_rows
from bench.engines.run import evaluation
from bench.law.contender import Contender
from bench.law.damping import Damping

ARM_TASK = "arm-regulation"


def run(
    law: Contender, damping: Damping, springs: Springs, starts, settings: Settings, arm: str
) -> tuple[np.ndarray, np.ndarray]:
    """Rows of `engines.native.impedance`, and q and qdot at the end, one per start.

    Args:
        law: its command at omega = 0 over kp is the error of orientation.
        starts: tasks.Start with joint angles and rates, in order.
        settings: `torque_limit` is what torques over rated ones may come to.
    """
    given = numbers(settings._replace(command_limit=settings.torque_limit))
    plant, still = (_model(arm, tasks.arm(arm).xml, settings.dt_s) for _ in range(2))
    data, standing, n = mujoco.MjData(plant), mujoco.MjData(still), tasks.arm(arm).joints
    work, kept = native.workspace(n)
    rows, ends, room = blank_rows(len(starts)), np.zeros((len(starts), 2 * n)), np.zeros((2 * MOST, MOST))
    rated = np.array(tasks.arm(arm).rated, dtype=float)
    loop()(
        evaluation(law), design_of(damping), None, World(native.view(plant, data), states(starts, n)),
        Orders(native.view(still, standing), work, address_of(room), springs, rated, ends),
        memory_of(law), start_rows(starts), given, rows, blank_curves(len(starts)),
    )  # fmt: skip
    del kept  # what the addresses of `work` point into, until here
    return rows, ends


@functools.lru_cache(maxsize=16)
def _model(arm: str, xml: str, dt_s: float) -> mujoco.MjModel:
    """A model that many simulations may share; xml: what the arm's file says now."""
    return model_of(tasks.task(ARM_TASK, arm).xml(dt_s), "euler")


loop = made_once(impedance.compile_arm)


@made_once
def design_of(damping: Damping):
    """A design of damping as the loop calls it."""
    return compile_function(damping.design, impedance.DESIGN)


def prepare(law: Contender, dampings) -> None:
    """Compile what `run` will need, or take it from the disk cache."""
    evaluation(law)
    for one in dampings:
        design_of(one)
    loop()
