"""The free body in MuJoCo.

Where MuJoCo's <orientation> actuator makes the command, ctrl is the goal; mj_fwdActuation shows the command before
the step, which computes it again (and under Runge-Kutta three times more within the tick).
"""

import math
from typing import NamedTuple

from bench.engines.arrays import Matrix
from bench.engines.loop import ACCELERATION, Action, Plant, Sensed, accelerate, episodes_of, sampled
from bench.engines.mujoco_view import Simulated, actuate, place, step
from bench.law.inputs import AT_REST, Goal
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot, from_quaternion, rotate
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command


class FreeBodyWorld(NamedTuple):
    """The simulation, whether an actuator makes the command, and of each start qpos and qvel."""

    sim: Simulated
    has_servo: int
    states: Matrix


class FreeBodyState(NamedTuple):
    """Hold the goal of the body; the rest is MuJoCo's."""

    quat_d: tuple
    goal: Goal


@kernel
def reset(body, k, start):
    """Place the body at a start."""
    place(body.sim, body.states, k)
    quat_d = (start[7], start[8], start[9], start[10])
    return FreeBodyState(quat_d, Goal(from_quaternion(quat_d), AT_REST, AT_REST))


@kernel
def quaternion(s):
    """Return the quaternion of the body, or the tool, as MuJoCo has it."""
    return (s[12], s[13], s[14], s[15])


@kernel
def sense(body, state, tick, numbers):
    """Read the sensors."""
    s = body.sim.sensordata
    R, omega = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8])), (s[9], s[10], s[11])
    speed = dot(omega, omega)
    hav = haversine(quaternion(s), state.quat_d)
    return Sensed(R, omega, state.goal, hav, speed, speed, speed, GOING, state.quat_d)


@kernel
def command(laws, body, sensed, now, gains, memory, numbers):
    """Command what the law says, or read what MuJoCo's actuator will do."""
    if body.has_servo:
        ctrl, f = body.sim.ctrl, body.sim.qfrc_actuator
        ctrl[0], ctrl[1], ctrl[2], ctrl[3] = sensed.extra
        actuate(body.sim)
        u = rotate(sensed.R, (f[0], f[1], f[2]))
        squared = dot(u, u)
        return Action(
            u, u, squared, math.nan, check_command(squared, numbers.command_limit_squared), ()
        ), memory
    return accelerate(laws, body, sensed, now, gains, memory, numbers)


@kernel
def advance(laws, body, state, action, gains, memory, numbers):
    """Let MuJoCo step."""
    if not body.has_servo:
        body.sim.ctrl[0], body.sim.ctrl[1], body.sim.ctrl[2] = action.u
    step(body.sim)
    return state, memory


@kernel
def measure(body, state, sensed):
    """Measure the angle to the goal."""
    return angle(quaternion(body.sim.sensordata), state.quat_d)


def loop_of(observe):
    """Return the loop of the free body, for all laws."""
    return episodes_of(Plant(reset, sense, advance, measure), ACCELERATION._replace(command=command), sampled(observe))
