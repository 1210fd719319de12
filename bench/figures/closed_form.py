"""What theory says of settling times, to be drawn beside what was measured.

Linear:      x'' = -Kp x - Kd x'                 feedback linearization, and every law near zero (Murphy 1988, 2.16)
Large turns: theta'' = -Kp sin(theta) - Kd theta'     the rotation-matrix law from rest (Murphy 1988, 2.12-2.13), whose
             axis never turns: e = sin(theta) k, and omega stays along k.

Settled is what the judge says: the last time at which the angle is the band's edge, `tolerance` times its beginning.
Close to a half turn phi = pi - theta grows as exp(r t) with r = sqrt(Kp + Kd^2/4) - Kd/2, so that each decade of
phi costs ln 10 / r.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

TIGHT = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-15}
"""Errors of 1e-11 are far below a tick; atol is below the smallest start, pi - theta = 1e-12 rad."""


def linear(times, kp: float, kv: float) -> np.ndarray:
    """Response of the linear system from x = 1 at rest; (1 + 10 t) exp(-10 t) for the paper's gains."""
    system = np.array([[0.0, 1.0], [-kp, -kv]])
    return np.array([expm(system * time)[0, 0] for time in times])


def linear_settling(kp: float, kv: float, tolerance: float) -> float:
    """Last time [s] at which the linear response is `tolerance` of its beginning."""
    return _last_crossing(lambda t, x: [x[1], -kp * x[0] - kv * x[1]], [1.0, 0.0], lambda x: x, tolerance, kp, kv, 1.0)


def settling(angle: float, kp: float, kv: float, tolerance: float, short: float | None = None) -> float:
    """Last time [s] at which the rotation-matrix law is at `tolerance` of an initial angle [rad]; infinite at pi.

    Args:
        short: pi - angle, where the angle itself has lost it to rounding.
    """
    short = math.pi - angle if short is None else short
    if short == 0.0:
        return math.inf
    return _last_crossing(
        lambda t, x: [x[1], kp * math.sin(x[0]) - kv * x[1]],
        [short, 0.0],
        lambda phi: math.pi - phi,
        tolerance * (math.pi - short),
        kp,
        kv,
        short,
    )


def decade_slope(kp: float, kv: float) -> float:
    """Seconds of settling time that a decade of pi - angle costs: ln 10 / (sqrt(Kp + Kd^2/4) - Kd/2)."""
    return math.log(10.0) / (math.sqrt(kp + kv * kv / 4.0) - kv / 2.0)


def _last_crossing(system, start, angle_of, band, kp, kv, short) -> float:
    def edge(_, state):
        return abs(angle_of(state[0])) - band

    slowest = (kv - math.sqrt(max(0.0, kv * kv - 4.0 * kp))) / 2.0  # rate of decay near the goal
    escape = max(0.0, -math.log10(short)) * decade_slope(kp, kv)
    end = escape + 12.0 / slowest  # exp(-12) is far inside any band
    found = solve_ivp(system, (0.0, end), start, events=edge, **TIGHT)
    return float(found.t_events[0][-1])
