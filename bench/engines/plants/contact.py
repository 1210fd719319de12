"""A task in contact in MuJoCo, a whole episode compiled; MuJoCo's errors end the episode and nothing else.

The loop is compiled once, for all arms, tasks and controllers: a controller comes as a function that is called by
pointer. The order of a tick is dm_control's, as on the arm. An episode ends when the hand is at rest
(`tasks.contact_rest`), and has a record in place of metrics.
"""

import math
from typing import Any, NamedTuple

from bench.control.hybrid import comply
from bench.engines.compiled import MATRIX, compile_loop, register, types
from bench.engines.contact_episode import (
    BROKEN,
    RESTED,
    Numbers,
    overload,
    sensed,
    setpoint,
    wrench,
    write_record,
)
from bench.engines.controllers import begin
from bench.engines.loop import Act, Controller, Plant, Record, episodes_of, pass_on
from bench.engines.native.contact import (
    ASSEMBLE,
    NUMBERS,
    TOUCH,
    VIEW,
    WORKSPACE,
    Body,
    ContactView,
    Workspace,
    open_simulation,
)
from bench.engines.native.libmujoco import mj_fullM
from bench.engines.native.trapped import BEGIN, RUNGE_KUTTA, STEP, step
from bench.law.contender import AT_REST
from bench.law.resolved_motion import Chain
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import Rotation, from_quaternion
from tasks.contact import leg
from tasks.contact_rest import has_left
from tasks.verdict import GOING, check_command, check_state


class World(NamedTuple):
    """The simulation, its buffers, the numbers of the trial, and the record to be filled."""

    view: ContactView
    work: Workspace
    shape: Numbers
    record: Any


class Laws(NamedTuple):
    """The rows of a controller."""

    assemble: Any
    second: Any
    third: Any


class Scene(NamedTuple):
    """The arrays of `World`."""

    body: Body
    shape: Numbers
    record: Any


class State(NamedTuple):
    """Orientation and place at first; where the hand was, at which tick, when rest was last counted; tick, failure."""

    R_d: Rotation
    p_0: tuple
    place: tuple
    frame: Rotation
    since: int
    tick: int
    failure: int


class Sensed(NamedTuple):
    """What the sensors say."""

    R: Rotation
    omega: tuple
    p: tuple
    f: tuple
    m: tuple
    chain: Chain


@kernel
def enter(world):
    """Return the arrays."""
    return Scene(open_simulation(world.view, world.work, world.shape.ticks), world.shape, world.record)


@kernel
def reset(scene, k, start):
    """Let MuJoCo compute what follows from the state that Python has put the scene into."""
    body, s = scene.body, scene.body.s
    body.asked[2] = BEGIN
    failure = BROKEN if step(body.batch, body.callback, body.asked_address) > 0 else GOING
    body.asked[2] = RUNGE_KUTTA if body.is_runge_kutta else STEP
    R_d, p_0 = from_quaternion(scene.shape.quat_d), (s[16], s[17], s[18])
    return State(R_d, p_0, p_0, R_d, 0, 0, failure)


@kernel
def sense(scene, state):
    """Read the sensors."""
    body, s = scene.body, scene.body.s
    R, p = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8])), (s[16], s[17], s[18])
    f, m = wrench(R, s)
    chain = Chain(body.n, body.axes, body.anchors, body.qvel, p, R)
    return Sensed(R, (s[9], s[10], s[11]), p, f, m, chain)


@kernel
def look(scene, state, tick, numbers):
    """Look whether the hand has left its place; no angle counts."""
    now = sense(scene, state)
    place, frame, since = state.place, state.frame, state.since
    if has_left(scene.shape.rest, tick, now.p, now.R, place, frame):
        place, frame, since = now.p, now.R, tick
    return State(state.R_d, state.p_0, place, frame, since, tick, state.failure), 1.0, 0.0


@kernel
def command(laws, scene, touch, state, now_sensed, now, gains, memory, numbers):
    """Compute the torques of a controller; the act's square is that of the largest over its rated one."""
    if state.failure != GOING:
        return Act(AT_REST, AT_REST, 0.0, math.nan, state.failure), memory
    body, shape, n = scene.body, scene.shape, scene.body.n
    f, m = sensed(now_sensed.f, now_sensed.m, scene.record, now.tick, shape.delay, body.noise)
    wanted = setpoint(state.R_d, state.p_0, shape, now.tick * numbers.dt)
    mj_fullM(body.model, body.data, body.D_address)
    for i in range(n):
        body.fg[i] = body.bias[i] - body.passive[i]
    chain, rows = now_sensed.chain, body.rows
    laws.assemble(chain, wanted, f, m, gains, touch, body.J, rows)
    comply(shape.form, shape.held, chain, body.D, body.fg, body.J, rows, gains, touch, body.room, body.tau)
    total, largest = overload(body.tau, shape.rated, n)
    failure = check_command(total, shape.torque_limit_squared)
    if failure == GOING and shape.rest.ticks > 0 and now.tick - state.since >= shape.rest.ticks:
        failure = RESTED
    return Act(AT_REST, AT_REST, largest, math.nan, failure), memory


@kernel
def see(row, curves, now, scene, touch, state, now_sensed, act, before, numbers):
    """Write the tick's line of the record."""
    if state.failure == GOING:
        body, s = scene.body, scene.body.s
        gap = s[body.gap] if body.gap >= 0 else 0.0
        turned = s[body.turned] if body.turned >= 0 else 0.0
        write_record(
            scene.record[now.tick], now.tick * numbers.dt, now_sensed.R, now_sensed.omega, now_sensed.p,
            now_sensed.f, now_sensed.m, gap, turned, sqrt(act.squared),
        )  # fmt: skip


@kernel
def advance(laws, scene, touch, state, act, gains, memory, numbers):
    """Apply the torques and the trial's push, and let MuJoCo step."""
    body = scene.body
    for i in range(body.n):
        body.ctrl[i] = body.tau[i]
    now = leg(scene.shape.legs, state.tick, numbers.ticks)
    for i in range(6):
        body.push[i] = body.legs[now, i]
    failure = BROKEN if step(body.batch, body.callback, body.asked_address) > 0 else GOING
    return State(state.R_d, state.p_0, state.place, state.frame, state.since, state.tick, failure), memory


@kernel
def check(scene, state, numbers):
    """End an episode that breaks or diverges."""
    if state.failure != GOING:
        return state.failure
    speed = 0.0
    for i in range(scene.body.nv):
        speed = speed + scene.body.qvel[i] * scene.body.qvel[i]
    return check_state(speed, numbers.speed_limit_squared)


@kernel
def end(scene, state):
    """Measure nothing."""
    return 1.0, 0.0


def compile_contact():
    """Compile the loop, for all of them."""
    for function in (leg, has_left):
        register(function)
    plant = Plant(enter, reset, sense, look, advance, check, end)
    loop = episodes_of(plant, Controller(Laws, pass_on, begin, command), Record(see))
    return compile_loop(loop, (ASSEMBLE,), types.NamedTuple((VIEW, WORKSPACE, NUMBERS, MATRIX), World), TOUCH)
