"""What theory says of settling times, to be held against what was measured.

Linear:      x'' = -Kp x - Kd x'                 feedback linearization, and every law near zero (Murphy 1988, 2.16)
Large turns: theta'' = -Kp sin(theta) - Kd theta'     the rotation-matrix law from rest (Murphy 1988, 2.12-2.13), whose
             axis never turns: e = sin(theta) k, and omega stays along k.

Close to 180° phi = pi - theta grows as exp(r t) with r = sqrt(Kp + Kd^2/4) - Kd/2, so that each decade of
phi costs ln 10 / r.
"""

import functools
import math

import numpy as np

from tasks.rules import RULES


def linear(times: float | np.ndarray, kp: float, kv: float) -> np.ndarray:
    """Return the linear response from x = 1 at rest; (1 + w t) exp(-w t) if it is critically damped, w = Kd/2."""
    t, decay = np.asarray(times), kv / 2
    square = decay * decay - kp
    if abs(square) < 1e-9 * kp:  # rounding of decay^2 - Kp; beyond it sinh(r t)/r is exact enough
        return (1 + decay * t) * np.exp(-decay * t)
    root = np.sqrt(complex(square))
    return (np.exp(-decay * t) * (np.cosh(root * t) + decay / root * np.sinh(root * t))).real


POINTS = 20_001
"""Points between which a crossing is looked for; twice, so that the second ones lie 1e-7 time constants apart."""


@functools.cache
def linear_settling(kp: float, kv: float, tolerance: float = RULES.tolerance) -> float:
    """Return the last time [s] at which the linear response is `tolerance` of its beginning.

    A straight line between two points at last errs by the square of their distance: 1e-13 of the time.
    """
    slowest = kv / 2 - math.sqrt(max(0.0, kv**2 / 4 - kp))  # rate of decay near the goal [1/s]
    first, last = 0.0, 20.0 / slowest  # exp(-20) = 2e-9, far below any tolerance
    for _ in range(2):
        times = np.linspace(first, last, POINTS)
        above = np.abs(linear(times, kp, kv)) - tolerance
        place = np.flatnonzero(above > 0.0)[-1]
        first, last = times[place : place + 2].tolist()
    before, after = above[place : place + 2].tolist()
    return first + (last - first) * before / (before - after)


def decade_slope(kp: float, kv: float) -> float:
    """Seconds of settling time that a decade of pi - angle costs: ln 10 / (sqrt(Kp + Kd^2/4) - Kd/2)."""
    return math.log(10) / (math.sqrt(kp + kv**2 / 4) - kv / 2)
