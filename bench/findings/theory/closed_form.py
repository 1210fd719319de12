"""What theory says of settling times, to be held against what was measured.

Linear:      x'' = -Kp x - Kd x'                 feedback linearization, and every law near zero (Murphy 1988, 2.16)
Large turns: theta'' = -Kp sin(theta) - Kd theta'     the rotation-matrix law from rest (Murphy 1988, 2.12-2.13), whose
             axis never turns: e = sin(theta) k, and omega stays along k.

Settled is what the judge says: the last time at which the angle is the band's edge, `tolerance` times its beginning.
Close to 180° phi = pi - theta grows as exp(r t) with r = sqrt(Kp + Kd^2/4) - Kd/2, so that each decade of
phi costs ln 10 / r.
"""

import math
from typing import Any

import numpy as np

from tasks.rules import RULES

TIGHT = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-15}
"""Errors of 1e-11 are far below a tick; atol is below the smallest start, pi - theta = 1e-12 rad."""


def linear(times: float | np.ndarray, kp: float, kv: float) -> np.ndarray:
    """Response of the linear system from x = 1 at rest; (1 + w t) exp(-w t) if it is critically damped, w = Kd/2."""
    t, decay = np.asarray(times), kv / 2
    square = decay * decay - kp
    if abs(square) < 1e-9 * kp:  # rounding of decay^2 - Kp; beyond it sinh(r t)/r is exact enough
        return (1 + decay * t) * np.exp(-decay * t)
    root = np.sqrt(complex(square))
    return (np.exp(-decay * t) * (np.cosh(root * t) + decay / root * np.sinh(root * t))).real


def linear_settling(kp: float, kv: float, tolerance: float = RULES.tolerance) -> float:
    """Last time [s] at which the linear response is `tolerance` of its beginning."""
    from scipy.optimize import brentq

    t = np.linspace(0.0, 20.0 / _slowest(kp, kv), 20_001)  # exp(-20) = 2e-9, far below any tolerance
    last = np.flatnonzero(np.abs(linear(t, kp, kv)) > tolerance)[-1]
    return brentq(lambda x: abs(linear(x, kp, kv)) - tolerance, t[last], t[last + 1])


def _slowest(kp: float, kv: float) -> float:
    """Rate of decay near the goal [1/s]."""
    return kv / 2 - math.sqrt(max(0.0, kv**2 / 4 - kp))


def settling(angle: float, kp: float, kv: float, tolerance: float, short: float | None = None) -> float:
    """Last time [s] at which the rotation-matrix law is at `tolerance` of an initial angle [rad]; infinite at pi.

    Args:
        short: pi - angle, where the angle itself has lost it to rounding.
    """
    from scipy.integrate import solve_ivp

    short = math.pi - angle if short is None else short
    if short == 0.0:
        return math.inf

    def edge(_: Any, state: np.ndarray) -> Any:
        return abs(math.pi - state[0]) - tolerance * (math.pi - short)

    escape = max(0.0, -math.log10(short)) * decade_slope(kp, kv)
    end = escape + 12.0 / _slowest(kp, kv)  # exp(-12) is far inside any band
    leaving = solve_ivp(
        lambda _, x: [x[1], kp * math.sin(x[0]) - kv * x[1]], (0.0, end), [short, 0.0], events=edge, **TIGHT
    )
    return float(leaving.t_events[0][-1])


def decade_slope(kp: float, kv: float) -> float:
    """Seconds of settling time that a decade of pi - angle costs: ln 10 / (sqrt(Kp + Kd^2/4) - Kd/2)."""
    return math.log(10) / (math.sqrt(kp + kv**2 / 4) - kv / 2)
