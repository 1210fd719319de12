"""Admittance over a position loop, pressed on a plane of any stiffness: up to which does it settle?

servo   a place that follows its command with a first-order lag and a delay, on a spring: held against its closed form
arm     the UR5e's hand, its place held by a double pole through the model of its inertia, on a plane in MuJoCo
"""

import math
from collections import deque
from collections.abc import Iterator

import numpy as np

import tasks
from bench.engines.contact_episode import USUAL
from bench.findings.theory.admittance import Admittance, Loop, lagged_limit, routh_limit, settles
from bench.findings.theory.contact_stability import Spring
from bench.studies.contact.by_torque import Tick, press
from bench.studies.contact.stability import ARM, DECADES, INERTANCE, RELAXATION_S, bisect_stiffness, mobility, scale

MASS, STIFFNESS, RATIO = 5.5, 214.1, 2.828427
SHIPPED = Admittance(MASS, 2.0 * RATIO * math.sqrt(MASS * STIFFNESS), STIFFNESS)
"""ros-controls/ros2_controllers@187bfd5, admittance_controller/test/test_params.yaml, about x: it has no defaults."""

FORCE_N = 15.0
LAGS_S = (0.0, 0.003, 0.01, 0.03)
DOUBLE_POLES = (300.0, 100.0, 30.0)
"""Bandwidth w of the arm's position loop [1/s]: its lag at low frequencies is 2/w."""
DELAYS_MS = (0, 2, 5, 10, 20)
TICKS = 20_000
"""Length of a servo's episode: 1 % off the limit an error grows or falls by e^4 and more."""
BISECTIONS = 16
"""Halvings of the logarithm of the stiffness over eight decades: to 0.1 %."""
HALVINGS = 9
"""Halvings of the stiffness of the plane that the arm presses on: to 1 %."""
HORIZON_S, RAMP_S = 4.0, 1.0
"""Length of the press, and the time until which the force ordered rises to FORCE_N, so that the tip does not strike."""
CALM_N = 1e-3
"""A force that varies by less no longer varies."""


def limits() -> list[dict]:
    """Return a row a plant, lag and delay: largest stable stiffness, measured and by theory [N/m]; null: no limit."""
    return [*_servos(), *_arms()]


def _servos() -> Iterator[dict]:
    dt = USUAL.dt_s
    for lag_s in LAGS_S:
        for delay in DELAYS_MS:
            late = round(1e-3 * delay / dt)
            yield {
                "plant": "servo",
                "lag_ms": 1e3 * lag_s,
                "delay_ms": delay,
                "measured": bisect_stiffness(
                    lambda K, lag_s=lag_s, late=late: is_damped(K, lag_s, late), 0.0, 8.0, BISECTIONS
                ),
                "theory": lagged_limit(SHIPPED, lag_s, late, dt),
                "continuous": routh_limit(SHIPPED, lag_s) if delay == 0 else math.nan,
            }


def _arms() -> Iterator[dict]:
    for w in DOUBLE_POLES:
        for delay in DELAYS_MS:
            yield {
                "plant": "arm",
                "lag_ms": 2e3 / w,
                "delay_ms": delay,
                "measured": bisect_stiffness(
                    lambda K, w=w, delay=delay: calms(pressed(K, w, delay)), *DECADES, HALVINGS
                ),
                "theory": bisect_stiffness(lambda K, w=w, delay=delay: predicted(K, w, delay), *DECADES, HALVINGS),
                "continuous": math.nan,
            }


def is_damped(K: float, lag_s: float, late: int) -> bool:
    """Whether a place that is a thousandth off its equilibrium on the spring is nearer to it after TICKS."""
    dt, (m, d, k) = USUAL.dt_s, SHIPPED
    a = math.exp(-dt / lag_s) if lag_s > 0.0 else 0.0
    rest = FORCE_N / (k + K)
    off = 1e-3 * rest
    x, c, rate, told = rest + off, rest + off, 0.0, deque([rest + off] * late)
    worst = 0.0
    for tick in range(TICKS):
        F = -K * max(x, 0.0)
        rate += dt * (FORCE_N + F - d * rate - k * c) / m
        c += dt * rate
        told.append(c)
        x = a * x + (1.0 - a) * told.popleft()
        if tick >= TICKS - TICKS // 10:
            worst = max(worst, abs(x - rest))
        elif abs(x - rest) > 1e3 * off:
            return False
    return worst < off


def pressed(stiffness: float, w: float, delay_ms: float) -> np.ndarray:
    """Return the normal force [N] over the ticks of an episode on the arm."""
    (m, d, k), dt = SHIPPED, USUAL.dt_s
    c, rate, time, told = 0.0, 0.0, 0.0, deque([0.0] * round(1e-3 * delay_ms / dt))

    def torque(now: Tick) -> np.ndarray:
        nonlocal c, rate, time
        time += dt
        ordered = FORCE_N * min(1.0, 0.1 + time / RAMP_S)
        rate += dt * (now.wrench[2] - ordered - d * rate - k * c) / m
        c += dt * rate
        told.append(c)
        error = now.error.copy()
        error[2] += told.popleft()
        wanted = w * w * error - 2.0 * w * now.twist
        return now.M @ np.linalg.solve(now.J, wanted) + now.bias

    return np.array([now.wrench[2] for now in press(ARM, stiffness, torque, HORIZON_S)])


def calms(force: np.ndarray) -> bool:
    """Whether the force of a whole episode varies less in its last quarter than in its second half's first."""
    if len(force) < round(HORIZON_S / USUAL.dt_s):
        return False
    _, _, before, last = np.array_split(force, 4)
    return bool(np.ptp(last) < max(np.ptp(before), CALM_N) and last.min() > 0.0)


def predicted(stiffness: float, w: float, delay_ms: float) -> bool:
    """Return what theory says of the same."""
    arm = tasks.arm(ARM)
    spring = Spring(stiffness, RELAXATION_S * stiffness, INERTANCE / (1.0 - INERTANCE) / scale(arm))
    return settles(SHIPPED, Loop(w, round(1e-3 * delay_ms / USUAL.dt_s), mobility(arm)), spring, USUAL.dt_s)
