"""A task in contact in MuJoCo, a whole episode compiled; MuJoCo's errors end the episode and nothing else.

The loop is compiled once, for all arms, tasks and controllers: a controller comes as a function that is called by
pointer. The order of a tick is dm_control's, as on the arm. An episode ends when the hand is at rest
(`tasks.contact_rest`), and has a record in place of metrics.
"""

import math
from typing import NamedTuple

import numpy as np

from bench.engines import contact_episode
from bench.engines.arm_episode import MOST, cut, load, squared
from bench.engines.arrays import Integers, Matrix, Vector
from bench.engines.contact_episode import BROKEN, RESTED, ContactNumbers, setpoint, wrench
from bench.engines.loop import NO_ACTION, Action, Controller, Plant, Record, Sensed, episodes_of
from bench.engines.mujoco_view import Simulated, fill_inertia
from bench.engines.native.trapped import BEGIN, RUNGE_KUTTA, STEP, advance_trapped
from bench.law.chain import Chain
from bench.law.control.hybrid import comply
from bench.law.control.setpoint import ContactBuffers, ContactParameters, Rows
from bench.law.inputs import AT_REST, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import Rotation, from_quaternion
from tasks.contact import MOST_LEGS, leg
from tasks.contact_rest import has_left
from tasks.verdict import GOING, check_command


class ContactWork(NamedTuple):
    """Buffers of a controller and of an episode: D (nv x nv), and the trial's pushes."""

    rows: Rows
    room: ContactBuffers
    J: Matrix
    D: Matrix
    fg: Vector
    tau: Vector
    legs: Matrix


class ContactWorld(NamedTuple):
    """A scene: the simulation with the arm's n joints first, and all that an episode needs.

    push: the wrench applied to the hand. gap, turned: places among the sensor values, -1 if there is none. batch,
    callback, asked: what steps MuJoCo, see `trapped`. record: to be filled. noise: of each reading of the wrench, or of
    all.
    """

    sim: Simulated
    n: int
    push: Vector
    gap: int
    turned: int
    batch: int
    callback: int
    asked: Integers
    work: ContactWork
    shape: ContactNumbers
    touch: ContactParameters
    record: Matrix
    noise: Matrix


def work(n: int, nv: int) -> ContactWork:
    """Return fresh buffers for an arm of n joints in a scene of nv degrees of freedom."""
    D, legs = np.zeros((nv, nv)), np.zeros((MOST_LEGS, 6))
    room = contact_episode.rows(), contact_episode.room()
    return ContactWork(*room, np.zeros((6, MOST)), D, np.zeros(n), np.zeros(n), legs)


class ContactState(NamedTuple):
    """What is wanted at first; the tick, why MuJoCo ends the episode, or GOING, and the last reading of the wrench."""

    R_d: Rotation
    p_0: tuple
    tick: int
    ended_by: int
    f: tuple
    m: tuple


class HandReading(NamedTuple):
    """The hand's place [m], force [N] and moment [N m] as they are read, its chain, and its place at first."""

    p: tuple
    f: tuple
    m: tuple
    chain: Chain
    p_0: tuple


class RestWatch(NamedTuple):
    """Hold the hand's place and the tick at which rest was last counted."""

    place: tuple
    frame: Rotation
    since: int


@kernel
def reset(body, k, start):
    """Let MuJoCo compute what follows from the state that Python has put the scene into."""
    body.asked[2] = BEGIN
    ended_by = BROKEN if advance_trapped(body) > 0 else GOING
    body.asked[2] = RUNGE_KUTTA if body.sim.is_runge_kutta else STEP
    s, R_d = body.sim.sensordata, from_quaternion(body.shape.quat_d)
    return ContactState(R_d, (s[16], s[17], s[18]), 0, ended_by, AT_REST, AT_REST)


@kernel
def read_wrench(body, state, R):
    """Return the force and moment as the controller gets them: read afresh, or the last reading."""
    s, ticks = body.sim.sensordata, body.shape.sensor_ticks
    if state.tick % ticks > 0:
        return state.f, state.m
    f, m = wrench(R, s)
    noise = body.noise[(state.tick // ticks) % body.noise.shape[0]]
    return (
        (f[0] + noise[0], f[1] + noise[1], f[2] + noise[2]),
        (m[0] + noise[3], m[1] + noise[4], m[2] + noise[5]),
    )


@kernel
def sense(body, state, tick, numbers):
    """Read the sensors; no angle counts."""
    sim, s, speed = body.sim, body.sim.sensordata, squared(body.sim.qvel, body.sim.n)
    R, omega = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8])), (s[9], s[10], s[11])
    p, (f, m) = (s[16], s[17], s[18]), read_wrench(body, state, R)
    hand = HandReading(p, f, m, Chain(body.n, sim.xaxis, sim.xanchor, sim.qvel, p, R), state.p_0)
    return Sensed(
        R, omega, Goal(state.R_d, AT_REST, AT_REST), 1.0, 0.0, speed, 0.0, state.ended_by, hand
    )


@kernel
def begin(laws, memory0, sensed_now):
    """Begin to count rest."""
    return RestWatch(sensed_now.extra.p, sensed_now.goal.R, 0), NO_ACTION


@kernel
def command(laws, body, sensed_now, now, gains, memory, numbers):
    """Compute the torques of a controller, whose rows are the law.

    The square of the action is that of the largest torque over its rated one.
    """
    sim, shape, work, hand, n = body.sim, body.shape, body.work, sensed_now.extra, body.n
    wanted = setpoint(sensed_now.goal.R, hand.p_0, shape, now.number * numbers.dt)
    fill_inertia(sim, work.D)
    for i in range(n):
        work.fg[i] = sim.qfrc_bias[i] - sim.qfrc_passive[i]
    laws.law(hand.chain, wanted, hand.f, hand.m, gains, body.touch, work.J, work.rows)
    comply(
        shape.form, shape.held, hand.chain, work.D, work.fg, work.J, work.rows, gains, body.touch, work.room, work.tau
    )
    if shape.is_cut > 0:
        cut(work.tau, shape.rated, n)
    total, largest = load(work.tau, shape.rated, n)
    failure = check_command(total, numbers.command_limit_squared)
    if has_left(shape.rest, now.number, hand.p, sensed_now.R, memory.place, memory.frame):
        memory = RestWatch(hand.p, sensed_now.R, now.number)
    elif (
        failure == GOING and shape.rest.ticks > 0 and now.number - memory.since >= shape.rest.ticks
    ):
        failure = RESTED
    return Action(AT_REST, AT_REST, largest, math.nan, failure, ()), memory


@kernel
def see(row, curves, now, body, sensed_now, action, before, numbers):
    """Write the tick's line of the record."""
    s, R, hand, record = (
        body.sim.sensordata,
        sensed_now.R,
        sensed_now.extra,
        body.record[now.number],
    )
    f, m = wrench(R, s)
    record[0] = now.number * numbers.dt
    for i in range(3):
        record[1 + i] = R.n[i]
        record[4 + i] = R.o[i]
        record[7 + i] = R.a[i]
        record[10 + i] = sensed_now.omega[i]
        record[13 + i] = hand.p[i]
        record[16 + i] = f[i]
        record[19 + i] = m[i]
    record[22] = s[body.gap] if body.gap >= 0 else 0.0
    record[23] = s[body.turned] if body.turned >= 0 else 0.0
    record[24] = sqrt(action.squared)


@kernel
def advance(laws, body, state, action, gains, memory, numbers):
    """Apply the torques and the trial's push, keep the reading of the wrench, and let MuJoCo step."""
    s = body.sim.sensordata
    f, m = read_wrench(body, state, Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8])))
    for i in range(body.n):
        body.sim.ctrl[i] = body.work.tau[i]
    now = leg(body.shape.legs, state.tick, numbers.ticks)
    for i in range(6):
        body.push[i] = body.work.legs[now, i]
    ended_by = BROKEN if advance_trapped(body) > 0 else GOING
    return ContactState(state.R_d, state.p_0, state.tick + 1, ended_by, f, m), memory


@kernel
def measure(body, state, sensed_now):
    """Measure no angle."""
    return 0.0


def loop():
    """Return the loop, for all arms, tasks and controllers."""
    return episodes_of(Plant(reset, sense, advance, measure), Controller(begin, command), Record(see))
