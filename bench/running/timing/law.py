"""A law alone: how long a controller waits for its command.

The law is compiled into a loop over states in memory. 0.0 * (u_x + u_y + u_z) of each command is added to R and omega
of the next state: it changes no number, but without fastmath a compiler must not leave it out, so each tick waits for
the command before it. What is measured is thus latency, from a state in memory to u, and not how many laws a
processor can overlap. The chain itself (three additions, a product, one more addition) and the loop are in every
number; `EMPTY`, a law that only returns omega, is timed beside the others to say how much that is.

Limitations: a law with a command that is not finite breaks the chain with NaN; it is not timed.
"""

import functools

import numpy as np

import tasks
from bench.engines.compiled import MATRIX, compile_function, float64, int64
from bench.engines.counting.states import BOUND_OVER_KP
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.kinds import Law
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, from_quaternion

STATES = 1000
SWEEPS = 20
"""Twenty times over all states: a fifth of a millisecond for the cheapest law, hundreds of times what a call costs."""

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
    """Seeded states, one a row: R by columns, omega, R_d by columns.

    Orientations and goals are uniform on SO(3). The goal differs from row to row, as in the count of operations,
    so that nothing computed of it can be kept from tick to tick.
    """
    starts = tasks.start_set("uniform", 2 * STATES, SEED)
    rotations = np.array([np.concatenate(from_quaternion(start.quat_wxyz)) for start in starts])
    omega = np.random.default_rng(SEED).normal(scale=SPIN, size=(STATES, 3))
    return np.ascontiguousarray(np.hstack((rotations[:STATES], omega, rotations[STATES:])))


def loop_of(command, memory0, cache=True):
    """`loop(states, kp, kv, sweeps)` -> the end of the chain: 0.0, or NaN if a command was not finite."""

    def loop(states, kp, kv, sweeps):
        gains = Tuning(kp, kv, BOUND_OVER_KP * kp, 0.0)
        memory = memory0
        chain = 0.0
        for _ in range(sweeps):
            for k in range(states.shape[0]):
                s = states[k]
                R = Rotation(
                    (s[0] + chain, s[1] + chain, s[2] + chain),
                    (s[3] + chain, s[4] + chain, s[5] + chain),
                    (s[6] + chain, s[7] + chain, s[8] + chain),
                )
                omega = (s[9] + chain, s[10] + chain, s[11] + chain)
                R_d = Rotation((s[12], s[13], s[14]), (s[15], s[16], s[17]), (s[18], s[19], s[20]))
                u, memory = command(R, omega, Goal(R_d, AT_REST, AT_REST), gains, memory)
                chain = 0.0 * (u[0] + u[1] + u[2])
        return chain

    return compile_function(loop, float64(MATRIX, float64, float64, int64), cache)
