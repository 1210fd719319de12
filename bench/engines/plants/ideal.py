"""The ideal plant of `engines.ideal` in the loop: one start at a time, by steps of one of three kinds."""

from typing import NamedTuple

from bench.engines.episode import STEP
from bench.engines.ideal import angle_between, haversine, held_step, rk4_step
from bench.engines.loop import ACCELERATION, Plant, Sensed, episodes_of, sampled
from bench.engines.refined import NO_EFFORT, Effort, refined_step, step_of
from bench.law.inputs import AT_REST, Goal
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot, from_quaternion
from tasks.verdict import DIVERGED, GOING


class IdealState(NamedTuple):
    """Orientation, angular velocity, goal, and the steps taken."""

    R: Rotation
    omega: tuple
    goal: Goal
    effort: Effort


@kernel
def reset(body, k, start):
    """Place the body at a start."""
    R = from_quaternion((start[0], start[1], start[2], start[3]))
    R_d = from_quaternion((start[7], start[8], start[9], start[10]))
    return IdealState(R, (start[4], start[5], start[6]), Goal(R_d, AT_REST, AT_REST), NO_EFFORT)


@kernel
def sense(body, state, tick, numbers):
    """Give the state itself; an episode that takes too many steps ends, and its row is not used."""
    R, omega, goal, effort = state
    speed = dot(omega, omega)
    ended_by = DIVERGED if effort.steps > numbers.most_steps else GOING
    return Sensed(R, omega, goal, haversine(R, goal.R), speed, speed, speed, ended_by, ())


@kernel
def measure(body, state, sensed):
    """Measure the angle to the goal."""
    return angle_between(sensed.R, sensed.goal.R)


@kernel
def by_whole_steps(laws, body, state, action, gains, memory, numbers):
    """Take one Runge-Kutta step a tick."""
    R, omega = rk4_step(
        laws.law, state.R, state.omega, action.u, state.goal, gains, memory, numbers.dt
    )
    return IdealState(R, omega, state.goal, state.effort), memory


@kernel
def by_refined_steps(laws, body, state, action, gains, memory, numbers):
    """Take steps as short as `refined` finds them necessary."""
    R, omega, goal, effort = state
    R, omega, memory, effort = refined_step(
        laws.law, R, omega, action.u, goal, gains, memory, numbers, effort
    )
    return IdealState(R, omega, goal, effort), memory


@kernel
def by_held_command(laws, body, state, action, gains, memory, numbers):
    """Hold the command over the tick."""
    R, omega = held_step(state.R, state.omega, action.u, numbers.dt)
    return IdealState(R, omega, state.goal, state.effort), memory


@kernel
def close(row, body, state, k, numbers):
    """Write down the shortest step."""
    row[STEP] = step_of(state.effort, numbers)


REFINED = "ideal-rk4-refined"
"""The name by which `convergence` takes the steps of `refined`; it is no engine of its own."""

STEPS = {"ideal-rk4": by_whole_steps, "ideal-held": by_held_command, REFINED: by_refined_steps}
"""A law is called by pointer, 10 ns each time, once a tick or four times. With the law compiled into a loop of its own
a Runge-Kutta tick was a sixth to a third shorter, and each law took 2 s and 16 MB an engine to compile."""


def loop_of(engine: str, observe):
    """Return the loop of an ideal plant, for all laws."""
    plant = Plant(reset, sense, STEPS[engine], measure)
    return episodes_of(plant, ACCELERATION, sampled(observe)._replace(close=close))
