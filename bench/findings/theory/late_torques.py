"""The greatest gains of a second-order law whose torques are late, near the goal.

    e' = omega,  omega' = u,  u = -(Kp e + Kv omega) of the tick that the torque answers,  Kp = (Kv/2)^2

Every axis of a loop that cancels its arm's dynamics is this one. The delays are recorded ones, tick by tick. With none
the limit is Kv T = 4 N (sqrt(1 + 1/N) - 1), T the control period, for a plant that MuJoCo moves in N steps (Jury).
"""

from __future__ import annotations

import functools

import numpy as np

from bench.base.bisection import bisect

GREATEST = 4.0
"""Kv T up to which a limit is looked for."""
HALVINGS = 12
LAST = 0.1
"""Part of an episode, its last, in which a loop that is not stable is farther from the goal than at its start."""


def find_greatest_kv(answered: np.ndarray, steps: int, period_s: float) -> float:
    """Return the Kv [1/s] above which the error grows; steps: of the plant in a control period.

    answered: of each step the tick, counted from 1, that its torque answers; 0 before the first.
    """
    is_stable = functools.partial(is_shrinking, answered.tolist(), steps, period_s)
    return bisect(is_stable, 0.0, GREATEST / period_s, HALVINGS)[0]


def is_shrinking(answered: list[int], steps: int, period_s: float, kv: float) -> bool:
    """Tell whether |e| is in the last part of the episode never greater than at its start."""
    kp, h, first = 0.25 * kv * kv, period_s / steps, (1.0 - LAST) * len(answered)
    e, omega, commands = 1.0, 0.0, [0.0]
    for step, tick in enumerate(answered):
        if step % steps == 0:
            if abs(e) > 1.0 and step >= first:
                return False
            commands.append(-kp * e - kv * omega)
        omega += h * commands[tick]
        e += h * omega
    return abs(e) <= 1.0
