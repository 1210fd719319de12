"""The free body in MuJoCo, stepped from compiled code: the dm_control loop bit for bit, without Python in it.

The order is dm_control's with legacy_step=True: mj_step1 | law | mj_step2, mj_step1 | law | ... (with Runge-Kutta
mj_step in place of mj_step2, which would silently be Euler). mjData's arrays never move, so plain views of them go
into the loop; no struct offset is needed.

Where MuJoCo's <orientation> actuator makes the command, ctrl is the goal; mj_fwdActuation shows the command before
the step, which computes it again (and under Runge-Kutta three times more within the tick).
"""

import math
from typing import NamedTuple

import mujoco
import numpy as np
from numba import float64, int32, int64, types

from bench.engines.compiled import CURVES, EVALUATE, FOUR, MATRIX, NUMBERS, compile_function
from bench.engines.curve import keep
from bench.engines.episode import Sample, blamed, finish
from bench.engines.native.libmujoco import mj_fwdActuation, mj_resetData, mj_step, mj_step1, mj_step2
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.so3 import Rotation, dot, from_quaternion, rotate
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command, check_state, first_watch, watched


class View(NamedTuple):
    """One mjData as compiled code sees it: two addresses and views of arrays that never move."""

    model: int
    data: int
    is_runge_kutta: int
    has_servo: int
    qpos: np.ndarray
    qvel: np.ndarray
    ctrl: np.ndarray
    qfrc_actuator: np.ndarray
    sensordata: np.ndarray
    warnings: np.ndarray


VIEW = types.NamedTuple((int64, int64, int64, int64, *[float64[::1]] * 5, int32[:]), View)
EPISODES = types.void(types.FunctionType(EVALUATE), FOUR, VIEW, MATRIX, MATRIX, NUMBERS, MATRIX, CURVES)


def view(model, data) -> View:
    """The view of one simulation; `data` must outlive it."""
    return View(
        model._address,
        data._address,
        int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4),
        int(model.actuator_gaintype[0] == mujoco.mjtGain.mjGAIN_SO3),
        data.qpos,
        data.qvel,
        data.ctrl,
        data.qfrc_actuator,
        data.sensordata,
        data.warning.number,
    )


def episodes_of(observe):
    """The loop over episodes, for all laws: `episodes(evaluate, memory0, ..., rows, curves)` fills the last two."""

    def episodes(evaluate, memory0, sim, states, starts, numbers, rows, curves):
        gains = Gains(numbers.kp, numbers.kv)
        dt = numbers.dt
        nq = sim.qpos.shape[0]
        s = sim.sensordata
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            quat_d = (start[7], start[8], start[9], start[10])
            R_d = from_quaternion(quat_d)
            goal = Goal(R_d, AT_REST, AT_REST)
            band = start[11]
            memory = memory0
            u = AT_REST
            mj_resetData(sim.model, sim.data)
            for i in range(nq):
                sim.qpos[i] = states[k, i]
            for i in range(sim.qvel.shape[0]):
                sim.qvel[i] = states[k, nq + i]
            mj_step1(sim.model, sim.data)
            hav = haversine((s[12], s[13], s[14], s[15]), quat_d)
            speed = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
            watch = first_watch(hav, band, speed, numbers.slow_squared)
            tick = 0
            failure = GOING
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                R = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]))
                omega, before = (s[9], s[10], s[11]), u
                if sim.has_servo:
                    sim.ctrl[0], sim.ctrl[1], sim.ctrl[2], sim.ctrl[3] = quat_d
                    mj_fwdActuation(sim.model, sim.data)
                    f = sim.qfrc_actuator
                    u, margin = rotate(R, (f[0], f[1], f[2])), math.nan
                else:
                    u, memory, margin = evaluate(R, omega, goal, gains, memory)
                sample = Sample(tick * dt, dt, R, hav, watch.entries > 0, watch.rest > 0, omega, u, before, margin)
                observe(row, sample)
                keep(curves, k, tick, sample)
                failure = check_command(dot(u, u), numbers.command_limit_squared)
                if failure != GOING:
                    break
                if not sim.has_servo:
                    sim.ctrl[0], sim.ctrl[1], sim.ctrl[2] = u
                if sim.is_runge_kutta:
                    mj_step(sim.model, sim.data)
                else:
                    mj_step2(sim.model, sim.data)
                mj_step1(sim.model, sim.data)
                tick += 1
                speed = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
                failure = check_state(speed, numbers.speed_limit_squared)
                if failure != GOING:
                    break
                hav = haversine((s[12], s[13], s[14], s[15]), quat_d)
                watch = watched(watch, tick, hav, band, speed, numbers.slow_squared)
            final = angle((s[12], s[13], s[14], s[15]), quat_d)
            finish(row, blamed(failure, u), watch, tick, final, speed, dot(u, u), numbers)

    return compile_function(episodes, EPISODES)
