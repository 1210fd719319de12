"""The greatest gains of a second-order law whose torques are late, near the goal.

    e' = omega,  omega' = u,  u = -(Kp e + Kv omega) of the tick that the torque answers,  Kp =
    (Kv/2)^2

Every axis of a loop that cancels its arm's dynamics is this one. The acceleration is constant
between two arrivals of torques, so that the motion from event to event is exact, and no step of an
integrator is in the result:

    e -> e + h omega + h^2/2 u,  omega -> omega + h u

`find_greatest_kv` takes recorded arrivals. `find_constant_limit` takes one delay d, a share of the
control period T: the eigenvalues of the map of (e, omega, u before) over a period. Without delay
the loop is lost at z = -1: the command changes its sign at each tick. A delay leaves the part d of
each period under the command before, of opposite sign, and weakens what alternates. With x = Kv T
the loop is at z = -1 where

    d (1 - d) x^2/8 - (1 - 2 d) x/2 + 1 = 0        of the rates alone, Kp = 0: x = 2/(1 - 2 d)

At greater delays a pair of complex eigenvalues is lost first.

Limitations: delays that change are replaced by one constant delay in `find_constant_limit` alone.
"""

from __future__ import annotations

import functools
import math

import numpy as np

from bench.base.bisection import bisect

HALVINGS = 14
"""Halvings of the interval of Kv T, whose limit is then known to 4/16,384."""
STEP = 0.01
"""In Kv T, between the gains at which the first unstable one of a constant delay is looked for."""


def find_greatest_kv(applied_s: np.ndarray, period_s: float, greatest: float, last: float) -> float:
    """Return the Kv [1/s] above which the error grows.

    Args:
        applied_s: From when on the torque that answers the state of each tick is there [s], from
        the first tick on;     NaN if that state was never answered.
        period_s: Control period [s].
        greatest: Kv T up to which the limit is looked for.
        last: Part of the episode, its last, in which the error of a stable loop is never greater
        than at its start.
    """
    events = list_events(applied_s, period_s)
    first = round((1.0 - last) * len(applied_s))
    is_stable = functools.partial(is_shrinking, events, first)
    return bisect(is_stable, 0.0, greatest / period_s, HALVINGS)[0]


def list_events(applied_s: np.ndarray, period_s: float) -> list[tuple[float, bool, int]]:
    """Return in order: time since the event before [s], whether it is a tick, and which."""
    ticks = np.arange(len(applied_s))
    answered = ticks[np.isfinite(applied_s)]
    instants = np.concatenate((period_s * ticks, applied_s[answered]))
    numbers = np.concatenate((ticks, answered))
    is_tick = np.arange(len(instants)) < len(ticks)
    # At the same instant the tick is first: its command may be the one that arrives.
    order = np.lexsort((~is_tick, instants))
    durations = np.diff(instants[order], prepend=0.0)
    return list(
        zip(durations.tolist(), is_tick[order].tolist(), numbers[order].tolist(), strict=True)
    )


def is_shrinking(events: list[tuple[float, bool, int]], first: int, kv: float) -> bool:
    """Tell whether |e| is from the tick `first` on never greater than at the start."""
    kp = 0.25 * kv * kv
    e, omega, u = 1.0, 0.0, 0.0
    commands: dict[int, float] = {}
    for duration, is_tick, tick in events:
        e += duration * (omega + 0.5 * duration * u)
        omega += duration * u
        if not is_tick:
            u = commands.pop(tick)
            continue
        if tick >= first and abs(e) > 1.0:
            return False
        commands[tick] = -kp * e - kv * omega
    return abs(e) <= 1.0


def compute_radius(gain: float, delay: float) -> float:
    """Compute the greatest |z| with Kv T = gain and torques late by a share of the period."""
    eigenvalues = np.linalg.eigvals(transition(gain, delay))
    return float(np.abs(eigenvalues).max())


def transition(gain: float, delay: float) -> np.ndarray:
    """Return the map of (e, T omega, T^2 u before) over a period; Kv T = gain, delay in [0, 1]."""
    command = np.array([-0.25 * gain * gain, -gain, 0.0])
    e, omega, before = np.eye(3)
    for duration, u in ((delay, before), (1.0 - delay, command)):
        e = e + duration * omega + 0.5 * duration * duration * u
        omega = omega + duration * u
    return np.array([e, omega, command])


@functools.cache
def find_constant_limit(delay: float) -> float:
    """Return the Kv T above which torques late by this share of the period lose the loop."""
    low = 0.0
    while compute_radius(low + STEP, delay) < 1.0:
        low += STEP
    return bisect(lambda gain: compute_radius(gain, delay) < 1.0, low, low + STEP, HALVINGS)[0]


def find_alternating_limit(delay: float) -> float:
    """Return the Kv T at which an eigenvalue is -1; NaN if there is none."""
    if delay == 0.0:
        return 2.0
    half, square = 0.5 * (1.0 - 2.0 * delay), delay * (1.0 - delay)
    root = half * half - 0.5 * square
    if half < 0.0 or root < 0.0:
        return math.nan
    return 4.0 * (half - math.sqrt(root)) / square
