"""What theory says of a perturbed loop, to be drawn beside what was measured.

Most is about the linear loop x'' = -Kp x - Kv x' that every isotropic law is near the goal, and that the rotation
vector's law is from rest at any angle.
"""

import functools
import math

import numpy as np
from scipy.linalg import solve_discrete_lyapunov
from scipy.signal import lsim

from bench.findings.theory.isotropic import Equation
from tasks.moving_goal import NO_FEEDFORWARD, RATE, reference_rates

STEP_S = 1e-3
"""Longest step of the plant [s], as in the episodes."""

LEAD = 2.0
"""Periods that the worst of measurements looks ahead."""

GRID_S = 5e-3
"""Between points [s] that are joined by straight lines; the goal sways with 0.3 s to the radian or slower."""

LEAVING_TICKS = 1500
"""Ticks after which a body that has not left 180° is held there: thirty time constants 1/Kv at 1 kHz."""


def crossover(kp: float, kv: float) -> float:
    """Return the angular frequency [rad/s] at which the open loop (Kv s + Kp)/s^2 has unit gain."""
    return math.sqrt((kv * kv + math.sqrt(kv**4 + 4.0 * kp * kp)) / 2.0)


def delay_margin(kp: float, kv: float) -> float:
    """Delay [s] from which the linear loop is unstable: phase margin arctan(Kv w/Kp) over crossover w."""
    w = crossover(kp, kv)
    return math.atan2(kv * w, kp) / w


def least_rate(kp: float, kv: float) -> float:
    """Control rate [Hz] at and below which the sampled linear loop is unstable: Kv h < 2 and Kp h < 2 Kv above it."""
    return max(kv / 2.0, kp / (2.0 * kv))


def sampled(kp: float, kv: float, period_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Return (A, B) of the closed sampled loop about one axis: state (x, x') from tick to tick, noise (x, x') added."""
    h = period_s
    free, pushed = np.array([[1.0, h], [0.0, 1.0]]), np.array([[0.5 * h * h], [h]])
    gains = np.array([[kp, kv]])
    return free - pushed @ gains, -pushed @ gains


def noisy_rms(kp: float, kv: float, period_s: float, attitude: float = 0.0, rate: float = 0.0) -> float:
    """Root mean square angle [rad] that white noise on orientation [rad] and rate [rad/s] leaves: sqrt(3 P_11).

    P, the covariance about one axis, solves P = A P A^T + B diag(attitude^2, rate^2) B^T.
    """
    A, B = sampled(kp, kv, period_s)
    P = solve_discrete_lyapunov(A, B @ np.diag([attitude**2, rate**2]) @ B.T)
    return math.sqrt(3.0 * P[0, 0])


@functools.cache
def tracking_rms(
    kp: float, kv: float, feedforward: int, period_s: float, horizon_s: float, tail_s: float = 1.0
) -> float:
    """Root mean square angle [rad] to a goal that moves little, over its peak rate [rad/s], at the end of an episode.

    e'' + Kv e' + Kp e = w,    w = alpha_d + Kv omega_d  without feedforward,   alpha_d  with the rate,
                                   (h/2) d(alpha_d)/dt   with both, for the command is held a tick of h
    """
    little = 1e-6
    times = np.arange(0.0, horizon_s + 0.5 * GRID_S, GRID_S)
    rates, accelerations = (
        np.array(part) / little for part in zip(*(reference_rates(time, little) for time in times), strict=True)
    )
    if feedforward == NO_FEEDFORWARD:
        push = accelerations + kv * rates
    elif feedforward == RATE:
        push = accelerations
    else:
        push = 0.5 * period_s * np.gradient(accelerations, GRID_S, axis=0)
    errors = np.column_stack([lsim(([1.0], [1.0, kv, kp]), one, times)[1] for one in push.T])
    tail = errors[times > horizon_s - tail_s]
    return math.sqrt(float((tail**2).sum(axis=1).mean()))


def is_held(equation: Equation, kp: float, kv: float, worst_error: float, period_s: float = STEP_S) -> bool:
    """Tell whether the worst noise holds a law at 180°: its scalar equation, evaluated every tick on a wrong angle.

    x is the angle by which the body has left 180°, of either sign. Within `worst_error` of it the law is given
    x - worst_error sgn(x + LEAD h x'), with the side where the body is about to be; it leaves once |x| is more.
    """
    h, x, v = period_s, 0.0, 0.0
    for _ in range(LEAVING_TICKS):
        if abs(x) > worst_error:
            return False
        seen = x - math.copysign(worst_error, x + LEAD * h * v)
        side, angle = math.copysign(1.0, seen), math.pi - abs(seen)
        # the angle is pi - |seen|: what shrinks it drives the body out on the side where it seems to be
        outward = kp * equation.spring(angle) - equation.added(angle, -side * v, kp, kv)
        u = side * outward - kv * v
        x, v = x + h * v + 0.5 * h * h * u, v + h * u
    return True
