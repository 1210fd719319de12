"""Admittance over a position loop, pressed on a spring of stiffness K: up to what K does the sampled loop settle?

    m cddot + d cdot + k c = F          what the measured force makes of the commanded place c, rates first, every dt
    x follows c of L ticks ago          lagged: T xdot = c - x, exact over a tick; or an arm's own second-order loop
    F = -K x

lagged  With a = exp(-dt/T) and H(z) = (dt^2/m) (1 - a) z^(1-L) / ((z - a)(z - 2 + 1/z + dt^2 k/m + (dt d/m)(1 - 1/z)))
        the limit is the least 1/|H| where H is real and negative on |z| = 1 (Nyquist). Without lag and k, by Jury:

            L = 0:  K = 2 (2 m - d dt)/dt^2            L = 1:  K = d/dt

        As dt -> 0 without delay, by Routh: K = (m + d T)(d + k T)/(m T) - k, or d/T + d^2/m without k.
arm     xddot = w^2 (c - x) - 2 w xdot + A F, whose place yields to the force by the arm's mobility A; the spring of
        `contact_stability`, stepped as MuJoCo does. It settles if no eigenvalue of the map is as long as 1.

So a lag or a delay of T needs some d >= K T, however soft the admittance is: that is why it feels sluggish in free
motion. An impedance has no such limit.

Limitations: says nothing of what leaves the surface and strikes again.
Source: Hogan 1985; Eppinger and Seering 1987; Jury 1964 and Routh for the polynomials.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from bench.base.bisection import bisect
from bench.findings.theory.contact_stability import Spring

ANGLES = 4000
"""Values of z on the half circle: between two of them the phase of H moves by far less than a turn."""


class Admittance(NamedTuple):
    """Mass [kg], damping [N s/m] and stiffness [N/m] of what the measured force moves."""

    m: float
    d: float
    k: float = 0.0


def response(z: Any, one: Admittance, lag_s: float, late: int, dt: float) -> Any:
    """H(z): place per force, at the boundary of stability -1/K."""
    a = math.exp(-dt / lag_s) if lag_s > 0.0 else 0.0
    admittance = (dt * dt / one.m) / (
        z - 2.0 + 1.0 / z + dt * dt * one.k / one.m + dt * one.d / one.m * (1.0 - 1.0 / z)
    )
    return admittance * (1.0 - a) * z ** (1 - late) / (z - a)


def lagged_limit(one: Admittance, lag_s: float, late: int, dt: float) -> float:
    """Return the stiffness [N/m] up to which the loop over a lagged position settles; late: ticks of delay."""
    phi = np.concatenate((np.geomspace(1e-5, 1e-2, ANGLES), np.linspace(1e-2, math.pi, ANGLES)[1:]))

    def imaginary(at: Any) -> Any:
        return np.imag(response(np.exp(1j * at), one, lag_s, late, dt))

    values = imaginary(phi)
    crossings = [_root(imaginary, *phi[i : i + 2]) for i in np.flatnonzero(values[:-1] * values[1:] < 0.0)]
    found = [np.real(response(np.exp(1j * at), one, lag_s, late, dt)) for at in (*crossings, math.pi)]
    return min(-1.0 / value for value in found if value < 0.0)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    sign = math.copysign(1.0, function(low))
    return 0.5 * sum(bisect(lambda at: sign * function(at) > 0.0, low, high, 60))


def routh_limit(one: Admittance, lag_s: float) -> float:
    """Compute the limit in continuous time without delay [N/m]; infinite without lag."""
    if lag_s <= 0.0:
        return math.inf
    return (one.m + one.d * lag_s) * (one.d + one.k * lag_s) / (one.m * lag_s) - one.k


class Loop(NamedTuple):
    """An arm's position loop: its double pole w [1/s], the delay of its command in ticks, and the mobility A [1/kg]."""

    w: float
    late: int
    mobility: float


def step(one: Admittance, loop: Loop, spring: Spring, dt: float) -> np.ndarray:
    """Return the map of (x, xdot, c, cdot, F, the last `late` commands) over one tick; F is the sensor's."""
    size = 5 + loop.late
    made = np.zeros((size, size))
    rate = np.zeros(size)
    rate[2], rate[3], rate[4] = -dt * one.k / one.m, 1.0 - dt * one.d / one.m, dt / one.m
    place = dt * rate
    place[2] += 1.0
    commanded = place if loop.late == 0 else np.eye(size)[-1]
    free = loop.w**2 * commanded
    free[0] -= loop.w**2
    free[1] -= 2.0 * loop.w
    stretched = np.zeros(size)
    stretched[:2] = spring.K, spring.B
    force = -(stretched + spring.inertance * free) / (1.0 + spring.inertance * loop.mobility)
    made[1] = dt * (free + loop.mobility * force)
    made[1, 1] += 1.0
    made[0] = dt * made[1]
    made[0, 0] += 1.0
    made[2], made[3], made[4] = place, rate, force
    if loop.late > 0:
        made[5] = place
        made[6:, 5:-1] = np.eye(loop.late - 1)
    return made


def settles(one: Admittance, loop: Loop, spring: Spring, dt: float) -> bool:
    """Whether the map shrinks."""
    return bool(np.abs(np.linalg.eigvals(step(one, loop, spring, dt))).max() < 1.0)
