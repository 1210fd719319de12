"""An arm in dm_control's own loop, the controller plain Python on numpy.float64 buffers.

See `free_body` for what this is the truth of; one tick takes a hundred times as long as compiled.
"""

import mujoco
import numpy as np

import tasks
from bench.control.resolved_acceleration import BY_JOINT, assembly, control
from bench.engines.arm_episode import (
    PROBE_TICKS,
    STANDING,
    ArmSample,
    blank_arm,
    buffers,
    controls,
    face_joints,
    joints,
    load,
    probe,
    seven,
    squared,
)
from bench.engines.binding import margin_of, memory_of, observer, parts_for
from bench.engines.episode import Settings, blamed, finish, numbers, vector
from bench.engines.reference.free_body import STILL
from bench.law.contender import Gains, Goal
from bench.law.resolved_motion import Chain
from bench.law.so3 import Rotation, dot, from_quaternion
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command, check_state, first_watch, watched


def run(
    contender, task: str, arm: str, starts, bands, settings: Settings, metrics, integrator="euler", variation="nominal"
) -> np.ndarray:
    """One row per start; see `arm_episode` for the columns."""
    rows = blank_arm(len(starts), metrics)
    with np.errstate(all="ignore"):
        for start, band, row in zip(starts, bands, rows, strict=True):
            _episode(contender, task, arm, start, band, settings, metrics, row, integrator, variation)
    return rows


def _episode(contender, task, arm_name, start, band, settings, metrics, row, integrator, variation):
    limits, arm = numbers(settings), tasks.arm(arm_name)
    dt, n = limits.dt, arm.joints
    margin, observe = margin_of(contender), observer(metrics)
    assemble, resolve = assembly(parts_for(contender)), contender.inverse.resolve
    own = variation != "nominal" or contender.inverse.gives == "joint-torque"
    environment = tasks.load(
        task, start=start, dt=dt, horizon=(limits.ticks + 1) * dt, integrator=integrator, arm=arm_name,
        vary=(lambda model: tasks.variation(variation).apply(model, arm.rated)) if variation != "nominal" else None,
    )  # fmt: skip
    environment.reset()
    plant = environment.physics.data
    model = mujoco.MjModel.from_xml_string(tasks.task(task, arm_name).xml(dt)) if own else environment.physics.model.ptr
    believed = mujoco.MjData(model) if own else plant.ptr
    shape, of_joints, into = controls(contender, own, settings.torque_limit), joints(arm), buffers(n)
    D, G = np.zeros((n, n)), np.zeros((7, 7))
    s = plant.sensordata
    R_d = from_quaternion(tuple(map(np.float64, start.goal_wxyz)))
    goal, p_d = Goal(R_d, STILL, STILL), vector(s[16:19])
    if start.goal_p:
        p_d = tuple(map(np.float64, start.goal_p))
    gains, memory = Gains(*map(np.float64, settings.gains)), tuple(map(np.float64, memory_of(contender)))
    hav = haversine(s[12:16], start.goal_wxyz)
    omega = vector(s[9:12])
    watch = first_watch(hav, band, dot(omega, omega), limits.slow_squared)
    u, tick, failure = (0.0, 0.0, 0.0), 0, GOING
    while tick < limits.ticks and watch.quiet < limits.hold_ticks:
        R = Rotation(vector(s[0:3]), vector(s[3:6]), vector(s[6:9]))
        p = vector(s[16:19])
        chain = Chain(n, plant.xaxis, plant.xanchor, plant.qvel, p, R)
        if own:
            believed.qpos[:] = plant.qpos
            believed.qvel[:] = plant.qvel if shape.has_own_model != STANDING else 0.0
            mujoco.mj_step1(model, believed)
        mujoco.mj_fullM(model, believed, D)
        fg = believed.qfrc_bias - believed.qfrc_passive
        if shape.gives_torque == BY_JOINT:
            face_joints(into.J, into.a, plant.qpos, start.goal_q or (np.nan,) * n, of_joints.inertia, n)
        before = u
        u, memory = control(
            assemble, resolve, shape.gives_torque, shape.rows, chain, D, fg, goal, p_d, gains, memory, into
        )
        torques = seven(into.tau, n)
        sample = ArmSample(
            tick * dt, dt, R, hav, watch.entries > 0, watch.rest > 0, omega, u, before, margin(R, R_d), p, p_d,
            seven(plant.qpos, n), seven(plant.qvel, n), torques, *of_joints[:3],
        )  # fmt: skip
        observe(row, sample)
        failure = check_command(load(torques, of_joints.rated), shape.torque_limit_squared)
        if tick % PROBE_TICKS == 0 or failure != GOING:
            probe(row, chain, plant.qpos, G, into.scratch)
        if failure != GOING:
            break
        environment.step(into.tau.copy())
        tick += 1
        failure = check_state(squared(plant.qvel, n), limits.speed_limit_squared)
        if failure != GOING:
            break
        hav = haversine(s[12:16], start.goal_wxyz)
        omega = vector(s[9:12])
        watch = watched(watch, tick, hav, band, dot(omega, omega), limits.slow_squared)
    final = angle(s[12:16], start.goal_wxyz)
    finish(row, blamed(failure, u), watch, tick, final, squared(plant.qvel, n), dot(u, u), limits)
