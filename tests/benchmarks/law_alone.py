"""A law alone: how long a controller waits for its command.

The law is compiled into a loop over states in memory. 0.0 * (u_x + u_y + u_z) of each command is
added to R and omega of the next state: it changes no number, but without fastmath a compiler must
not leave it out, so each tick waits for the command before it. What is measured is thus latency,
from a state in memory to u, and not how many laws a processor can overlap. The chain itself (three
additions, a product, one more addition) and the loop are in every number; `empty_loop`, a law that
only returns omega, is timed beside the others to say how much that is.

Limitations: a law with a command that is not finite breaks the chain with NaN; it is not timed.
"""

import functools

import numpy as np

import tasks
from bench.engines.binding import command_of, memory_of
from bench.engines.compiled import bind, compile_on_demand
from bench.engines.counting.states import BOUND_OVER_KP
from bench.law.contender import Contender
from bench.law.inputs import AT_REST, Gains, Goal, Tuning
from bench.law.kinds import Law
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, from_quaternion
from benchmarks.subject import LAW, LOOP, Subject

STATES = 1000
BLOCKS = 4
SWEEPS = 5
"""Four times the states with other goals, five times over: 0.7 MB fit a second-level cache. The
20,000 ticks of a call take 0.3 ms with the cheapest law, hundreds of times what the call costs."""

GOAL = 12
"""Column of a state at which its goal begins."""

SPIN = 2.0
"""Standard deviation of each component of omega [rad/s]; no law's branches look at omega."""

SEED = 0


@kernel
def _omega(R, omega, goal, gains):
    return omega


EMPTY = Law("empty", "No law", "", "u = \\omega", law=_omega)
"""Costs nothing: its time is the loop's and the chain's."""


@functools.cache
def states() -> np.ndarray:
    """Return seeded states, one a row: R by columns, omega, R_d by columns; shape (STATES, 21).

    Orientations and goals are uniform on SO(3). The goal differs from row to row, as in the count
    of operations, so that nothing computed of it can be kept from tick to tick.
    """
    starts = tasks.start_set("uniform", 2 * STATES, SEED)
    columns = [np.concatenate(from_quaternion(start.quat_wxyz)) for start in starts]
    rotations = np.array(columns)
    random = np.random.default_rng(SEED)
    omega = random.normal(scale=SPIN, size=(STATES, 3))
    table = np.hstack((rotations[:STATES], omega, rotations[STATES:]))
    return np.ascontiguousarray(table)


@functools.cache
def shared_rows() -> np.ndarray:
    """Return the rows that every law runs over, shape (BLOCKS STATES, 21); `shuffle` fills them."""
    return np.tile(states(), (BLOCKS, 1))


def shuffle(number: int) -> None:
    """Write the states into the shared rows in the order of a round, the same in every process.

    A processor learns the branches of a thousand states that come again and again, in one process
    but not in another: a law with a branch then took 1.5 times as long.
    """
    draw = np.random.default_rng(number)
    given = states()
    for block in np.split(shared_rows(), BLOCKS):
        states_order = draw.permutation(STATES)
        goals_order = draw.permutation(STATES)
        block[:, :GOAL] = given[states_order, :GOAL]
        block[:, GOAL:] = given[goals_order, GOAL:]


def compile_loop(command, memory0, cache=True):
    """Return `loop(states, kp, kv, sweeps)`, which returns the end of the chain.

    That is 0.0, or NaN if a command was not finite.
    """

    def loop(states, kp, kv, sweeps):
        gains = Tuning(kp, kv, BOUND_OVER_KP * kp, 0.0)
        memory = memory0
        chain = 0.0
        for _ in range(sweeps):
            for k in range(states.shape[0]):
                s = states[k]
                n = (
                    s[0] + chain,
                    s[1] + chain,
                    s[2] + chain,
                )
                o = (
                    s[3] + chain,
                    s[4] + chain,
                    s[5] + chain,
                )
                a = (
                    s[6] + chain,
                    s[7] + chain,
                    s[8] + chain,
                )
                R = Rotation(n, o, a)
                omega = (
                    s[9] + chain,
                    s[10] + chain,
                    s[11] + chain,
                )
                n_d = (s[12], s[13], s[14])
                o_d = (s[15], s[16], s[17])
                a_d = (s[18], s[19], s[20])
                goal = Goal(Rotation(n_d, o_d, a_d), AT_REST, AT_REST)
                u, memory = command(R, omega, goal, gains, memory)
                chain = 0.0 * (u[0] + u[1] + u[2])
        return chain

    return compile_on_demand(loop, cache)


def law_alone(contender: Contender) -> Subject:
    """Return the subject of a law alone."""
    is_ours = not contender.regulator.origin
    loop = compile_loop(command_of(contender), memory_of(contender), cache=is_ours)
    rows = shared_rows()
    gains = Gains()

    call = bind(loop, rows, gains.kp, gains.kv, SWEEPS)
    is_finite = call() == 0.0
    ticks = SWEEPS * len(rows) if is_finite else 0
    return Subject(LAW, call, ticks, contender, prepare=shuffle)


def empty_loop() -> Subject:
    """Return the subject of the loop and the chain, which every law's time holds."""
    alone = law_alone(Contender(EMPTY))
    return Subject(LOOP, alone.call, alone.ticks, prepare=shuffle)
