"""dm_control's own loop with the plain Python law: slow, and the truth the compiled engines must reproduce.

The law is called with numpy.float64 throughout, gains and goal too: its arithmetic is IEEE 754 (1/0 is infinite, 0/0
NaN), as compiled code's is. Where MuJoCo's <orientation> actuator makes the command, the action is the goal.
"""

import mujoco
import numpy as np

import tasks
from bench.engines.binding import command_of, margin_of, memory_of, observer, plant_of
from bench.engines.episode import Sample, Settings, blamed, blank, finish, numbers, vector
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.so3 import Rotation, dot, from_quaternion, rotate
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command, check_state, first_watch, watched

STILL = tuple(map(np.float64, AT_REST))


def run(contender, task: str, starts, bands, settings: Settings, metrics, integrator="euler") -> np.ndarray:
    """One row per start; see `episode` for the columns."""
    margin, observe = margin_of(contender), observer(metrics)
    rows = blank(len(starts), metrics)
    with np.errstate(all="ignore"):
        for start, band, row in zip(starts, bands, rows, strict=True):
            _episode(contender, margin, observe, task, start, band, settings, row, integrator)
    return rows


def _episode(contender, margin, observe, task, start, band, settings, row, integrator):
    limits = numbers(settings)
    dt = limits.dt
    plant = plant_of(contender, task, settings.gains)
    environment = tasks.load(plant, start=start, dt=dt, horizon=(limits.ticks + 1) * dt, integrator=integrator)
    environment.reset()
    has_servo = contender.regulator.in_engine
    command = _servo(environment.physics, start.goal_wxyz) if has_servo else command_of(contender)
    sensors = environment.physics.data.sensordata
    R_d = from_quaternion(tuple(map(np.float64, start.goal_wxyz)))
    goal = Goal(R_d, STILL, STILL)
    gains, memory = Gains(*map(np.float64, settings.gains)), tuple(map(np.float64, memory_of(contender)))
    hav = haversine(sensors[12:16], start.goal_wxyz)
    u, omega, tick, failure = (0.0, 0.0, 0.0), vector(sensors[9:12]), 0, GOING
    watch = first_watch(hav, band, dot(omega, omega), limits.slow_squared)
    while tick < limits.ticks and watch.quiet < limits.hold_ticks:
        R = Rotation(vector(sensors[0:3]), vector(sensors[3:6]), vector(sensors[6:9]))
        before = u
        u, memory = command(R, omega, goal, gains, memory)
        at_rest = watch.rest > 0
        observe(row, Sample(tick * dt, dt, R, hav, watch.entries > 0, at_rest, omega, u, before, margin(R, R_d)))
        failure = check_command(dot(u, u), limits.command_limit_squared)
        if failure != GOING:
            break
        environment.step(np.array(start.goal_wxyz if has_servo else u))
        omega = vector(sensors[9:12])
        tick += 1
        failure = check_state(dot(omega, omega), limits.speed_limit_squared)
        if failure != GOING:
            break
        hav = haversine(sensors[12:16], start.goal_wxyz)
        watch = watched(watch, tick, hav, band, dot(omega, omega), limits.slow_squared)
    final = angle(sensors[12:16], start.goal_wxyz)
    finish(row, blamed(failure, u), watch, tick, final, dot(omega, omega), dot(u, u), limits)


def _servo(physics, goal_wxyz):
    """MuJoCo's own command in the place of a law's, as it will be in the step."""

    def command(R, omega, goal, gains, memory):
        physics.set_control(goal_wxyz)
        mujoco.mj_fwdActuation(physics.model.ptr, physics.data.ptr)
        return rotate(R, vector(physics.data.qfrc_actuator)), memory

    return command
