"""Episodes of arms: by torques, by velocities, by impedances that shape no inertia, and in contact."""

import functools
import math
from collections.abc import Callable

import mujoco
import numpy as np

import tasks
from bench.engines import reference, signatures
from bench.engines.arm_episode import blank_arm, controls, joints, states
from bench.engines.binding import margin_of, memory_of, parts_for
from bench.engines.compiled import compile_function, compile_once, own_law, part
from bench.engines.curve import Curves
from bench.engines.episode import Metrics, Settings, Starts, blank, numbers, start_rows
from bench.engines.mujoco_view import compiled_view
from bench.engines.native.libmujoco import model_of, skip_constraints
from bench.engines.plants import arm as arm_plant
from bench.engines.plants import impedance, velocity
from bench.engines.plants.impedance import Springs
from bench.engines.simulate import compiled_loop, evaluation, simulate
from bench.law.contender import Contender
from bench.law.control.resolved_acceleration import assembly
from bench.law.kinds import Impedance
from tasks.arm_model import Arm
from tasks.velocity import servo

IDEAL_MOTORS = "ideal-motors"
"""The variation of the plant that the paper assumes."""
ARM_TASK = "arm-regulation"


def run_arm(
    engine: str, contender: Contender, task: str, arm: str, starts: Starts, settings: Settings, metrics: Metrics,
    integrator: str = "euler", variation: str = IDEAL_MOTORS, curves: Curves | None = None,
) -> np.ndarray:  # fmt: skip
    """Return rows of `engines.arm_episode`, one per start.

    metrics: in the order of their columns. variation: how the plant differs from the controller's model. curves: filled
    too, on the engine `native`.
    """
    if engine == "reference":
        return reference.run_arm(contender, task, arm, starts, settings, metrics, integrator, variation)
    owners, world = arm_world(contender, task, arm, starts, settings, integrator, variation)
    rows, limits, loop = blank_arm(len(starts), metrics), numbers(settings), compiled_loop("arm", tuple(metrics))
    simulate(loop, pointers(contender), world, memory_of(contender), start_rows(starts), limits, rows, curves)
    del owners  # it kept the models and data alive whose addresses the compiled code read
    return rows


def arm_world(
    contender: Contender, task: str, arm: str, starts: Starts, settings: Settings, integrator: str,
    variation: str = IDEAL_MOTORS,
) -> tuple[list, arm_plant.ArmWorld]:  # fmt: skip
    """Return the models of one arm, the plant and the controller's if it is another one, and the world of the loop."""
    one, plant_of = tasks.arm(arm), tasks.variation(variation)
    believed = plant_of.believed
    plant = _simulation(task, one, settings.dt_s, integrator, variation)
    shape = controls(contender, bool(believed), settings.torque_limit, plant[0], plant_of.lag_s, one.torque_rate)
    own = _simulation(task, one, settings.dt_s, integrator, believed or variation) if shape.has_own_model else plant
    work = arm_plant.work(one.joints, plant_of.late_ticks(settings.dt_s), shape.change)
    hinges = joints(one, believed or variation)
    views = compiled_view(*plant), states(starts, one.joints), compiled_view(*own)
    return [plant, own], arm_plant.ArmWorld(*views, work, shape, hinges)


def _simulation(task: str, arm: Arm, dt_s: float, integrator: str = "euler", variation: str = IDEAL_MOTORS) -> tuple:
    model = _model(task, arm, dt_s, integrator, variation)
    return model, mujoco.MjData(model)


@functools.lru_cache(maxsize=64)
def _model(task: str, arm: Arm, dt_s: float, integrator: str, variation: str) -> mujoco.MjModel:
    """Return a model that many simulations may share: stepping does not change it."""
    model = model_of(tasks.task(task, arm.name).xml(dt_s), integrator)
    tasks.variation(variation).apply(model, arm.rated)
    return skip_constraints(model)


def pointers(contender: Contender) -> tuple:
    """Compile a contender's three functions, or take them from the disk cache; a user's law is compiled every time."""
    law = contender._replace(jacobian=None, inverse=None)
    return _assemble(contender._replace(inverse=None)), _resolve(contender), part(margin_of(law), signatures.MARGIN)


def _resolve(contender: Contender) -> Callable:
    """Return the inverse of a contender that has one."""
    assert contender.inverse is not None
    return part(contender.inverse.resolve, signatures.RESOLVE)


@compile_once
def _assemble(contender: Contender) -> Callable:
    with own_law(contender.regulator.origin) as cache:
        return compile_function(assembly(parts_for(contender)), signatures.ASSEMBLE, cache)


def run_velocity(
    contender: Contender, limit: Callable, K: float, starts: Starts, settings: Settings, arm: str = "",
    lag_s: float = 0.0,
) -> np.ndarray:  # fmt: skip
    """Return rows of `plants.velocity`, one per start; nothing moves before a command.

    contender: a velocity law; on an arm with its Jacobian and inverse. K: its gain [1/s]. lag_s: time constant of the
    joints' servos [s]; 0: none. Those of the free body have none.
    """
    pace = velocity.Pace(float(K), servo(float(settings.dt_s), float(lag_s)))
    law, rows = (
        contender._replace(jacobian=None, inverse=None),
        blank(len(starts), more=(*[0.0] * 5, 0.0 if arm else math.nan)),
    )
    given = memory_of(law), start_rows(starts), numbers(settings), rows
    functions = evaluation(law), part(limit, signatures.LIMIT)
    if not arm:
        return simulate(compiled_loop("velocity"), functions, pace, *given)
    n, (model, data) = tasks.arm(arm).joints, _simulation(ARM_TASK, tasks.arm(arm), settings.dt_s)
    still, work = states([one._replace(qdot=(0.0,) * n) for one in starts], n), arm_plant.work(n)
    work.D[:] = np.eye(n)
    world = velocity.VelocityWorld(compiled_view(model, data), still, work, pace)
    return simulate(compiled_loop("velocity-arm"), (*functions, _resolve(contender)), world, *given)


def run_impedance(
    law: Contender, damping: Impedance, springs: Springs, starts: Starts, settings: Settings, arm: str,
    variation: str = IDEAL_MOTORS,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Return rows of `plants.impedance`, and q and qdot at the end, one per start.

    law: its command at omega = 0 over kp is the error of orientation. settings: `torque_limit` is what torques over
    rated ones may come to. variation: of plant and model alike.
    """
    limits, one = numbers(settings._replace(command_limit=settings.torque_limit)), tasks.arm(arm)
    owners = [_simulation(ARM_TASK, one, settings.dt_s, variation=variation) for _ in range(2)]
    plant, still = (compiled_view(*sim) for sim in owners)
    world = impedance.world(plant, still, states(starts, one.joints), springs, one.rated)
    rows, laws = blank(len(starts), more=impedance.COLUMNS), (evaluation(law), part(damping.design, signatures.DESIGN))
    simulate(compiled_loop("impedance"), laws, world, memory_of(law), start_rows(starts), limits, rows)
    del owners  # it kept the models and data alive whose addresses the compiled code read
    return rows, world.ends
