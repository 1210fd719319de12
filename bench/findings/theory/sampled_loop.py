"""The linear loop near the goal, sampled and late, about each principal axis.

    J x'' = u,   u = -(kp x + kv x') of a tick, held for a period T from a delay d after the measurement on

With d = (m + f) T, m whole and 0 <= f < 1, the command of tick n acts from (n + m + f) T to (n + m + 1 + f) T. In each
period the plant has two constant commands, so the step from tick to tick is exact:

    x+  = x + T x' + T^2 [f (1 - f/2) u_(n-m-1) + (1 - f)^2/2 u_(n-m)] / J
    x'+ = x' + T [f u_(n-m-1) + (1 - f) u_(n-m)] / J

Every law of the map is this loop near its goal: its command has the slopes kp and kv there (tests hold each to that).
Two of them, the weighted columns and the synergistic law, have 1.1 kp, kp and 0.9 kp about three axes.
The moments of the body are J (1 - s), J and J (1 + s) times the model's; at rest the axes do not act on each other.

Limitations: a delay of more than MOST_TICKS periods is computed with a longer period and the same sum of delay and half
a period. The simulator rounds a delay to its step, 0.01/sqrt(kp) at most; here it is not rounded.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.base.bisection import bisect
from tasks.rules import RULES

MOST_TICKS = 60
"""Whole periods of delay up to which each command on its way is a state of its own."""

FACTOR = 1.04
"""Between neighbours of the values among which a limit is looked for."""

HALVINGS = 24
"""Halvings of the interval between such neighbours: to 3e-9 of it."""

QUICKER = 100.0
"""How much higher a rate is looked at, at most."""

SAMPLES = 4000
"""Ticks at most at which a response is looked at."""


class SampledLoop(NamedTuple):
    """Gains over the model's inertia [1/s^2], [1/s]; times [s]; the true inertia over the model's, and unevenness s."""

    kp: float
    kv: float
    period: float
    delay: float = 0.0
    inertia: float = 1.0
    unevenness: float = 0.0

    @property
    def zeta(self) -> float:
        """Return the damping ratio of the model's loop."""
        return 0.5 * self.kv / math.sqrt(self.kp)

    @property
    def moments(self) -> tuple[float, ...]:
        """Return the principal moments over the model's, without repetition."""
        factors = (1.0 - self.unevenness, 1.0, 1.0 + self.unevenness)
        return tuple(dict.fromkeys(self.inertia * factor for factor in factors))

    def with_kv(self, kv: float) -> SampledLoop:
        """Return the loop with another kv at the same damping ratio."""
        return self._replace(kv=kv, kp=(0.5 * kv / self.zeta) ** 2)


def transition(loop: SampledLoop, moment: float) -> np.ndarray:
    """Return the matrix from tick to tick about an axis; states: x, x', and the commands on their way, newest first."""
    period, delay = loop.period, loop.delay
    if delay > MOST_TICKS * period:
        # A command of age d, held for T, is d + T/2 old in the mean: that sum is kept.
        mean_age = delay + 0.5 * period
        period = mean_age / (MOST_TICKS + 0.5)
        delay = MOST_TICKS * period
    whole = math.floor(delay / period + 1e-12)
    part = max(0.0, delay / period - whole)
    measured = np.zeros(whole + 3)
    measured[:2] = -loop.kp, -loop.kv
    step = np.zeros((whole + 3, whole + 3))
    step[:2, :2] = (1.0, period), (0.0, 1.0)
    push_late = np.array([part * (1.0 - 0.5 * part) * period**2, part * period]) / moment
    push_new = np.array([0.5 * (1.0 - part) ** 2 * period**2, (1.0 - part) * period]) / moment
    # u_(n-m-1) is the last state; u_(n-m) is the one before it or, with m = 0, the command of now.
    step[:2, whole + 2] += push_late
    if whole:
        step[:2, whole + 1] += push_new
    else:
        step[:2] += np.outer(push_new, measured)
    step[2] = measured
    for place in range(3, whole + 3):
        step[place, place - 1] = 1.0
    return step


def spectral_radius(loop: SampledLoop) -> float:
    """Return the greatest size of an eigenvalue, of any axis: errors grow by it a tick where it is above 1."""
    return max(float(np.abs(np.linalg.eigvals(transition(loop, moment))).max()) for moment in loop.moments)


def is_stable(loop: SampledLoop) -> bool:
    """Tell whether every error near the goal dies out."""
    return spectral_radius(loop) < 1.0


def settling_time(loop: SampledLoop, horizon: float) -> float:
    """Return the time [s] after which an error that began at rest stays below the band, of the slowest axis.

    Beyond the horizon: the time in which the slowest mode shrinks to it. Infinite for a loop that is not stable.
    """
    return max(_settling_about(loop, moment, horizon) for moment in loop.moments)


def _settling_about(loop: SampledLoop, moment: float, horizon: float) -> float:
    step = transition(loop, moment)
    radius = float(np.abs(np.linalg.eigvals(step)).max())
    if radius >= 1.0:
        return math.inf
    ticks = math.ceil(horizon / loop.period)
    stride = math.ceil(ticks / SAMPLES)
    strides = np.linalg.matrix_power(step, stride)
    state = np.zeros(len(step))
    state[0] = 1.0
    last = 0
    for place in range(0, ticks + 1, stride):
        if abs(state[0]) > RULES.tolerance:
            last = place
        state = strides @ state
    if last + stride <= ticks:
        return (last + stride) * loop.period
    return max(horizon, mode_time(radius, loop.period))


def mode_time(radius: float, period: float) -> float:
    """Return the time [s] in which a mode of this radius shrinks to the band."""
    return period * math.log(RULES.tolerance) / math.log(radius) if radius < 1.0 else math.inf


class StabilityLimits(NamedTuple):
    """What makes an unstable loop stable, one number changed at a time; NaN: no value of that number alone does.

    kv, kp: below this kv, at the same damping ratio; kp is what it then is. kv_low, kv_high: between these at the same
    kp. kp_alone: below this kp at the same kv. delay: below it [s]. rate: above it [Hz].
    """

    kv: float
    kp: float
    kv_low: float
    kv_high: float
    kp_alone: float
    delay: float
    rate: float


def find_limits(loop: SampledLoop) -> StabilityLimits:
    """Return the limits of a loop, each found from the side on which it is stable."""
    # So small that the loop is slow beside its own delay and period, whatever its damping ratio of use is.
    slow_kv = 1e-3 * min(loop.moments) / (loop.delay + loop.period)
    kv = last_stable(loop.with_kv, slow_kv, FACTOR, loop.kv)
    kv_low, kv_high = find_band(loop)
    # Far below kp the loop is the damper alone, which is stable or is not.
    kp_alone = last_stable(lambda kp: loop._replace(kp=kp), 1e-6 * loop.kp, FACTOR, loop.kp)
    delay = math.nan
    if loop.delay > 0.0 and is_stable(loop._replace(delay=0.0)):
        delay = last_stable(lambda delay: loop._replace(delay=delay), 1e-3 * loop.delay, FACTOR, loop.delay)
    rate = last_stable(
        lambda rate: loop._replace(period=1.0 / rate),
        QUICKER / loop.period,
        1.0 / FACTOR,
        1.0 / loop.period,
    )
    return StabilityLimits(kv, loop.with_kv(kv).kp, kv_low, kv_high, kp_alone, delay, rate)


def find_band(loop: SampledLoop) -> tuple[float, float]:
    """Return the least and greatest kv between which the loop is stable at its kp; of several bands the nearest one."""
    factors = FACTOR ** np.arange(-120, 121)
    values = [loop.kv * factor for factor in factors]
    stable = [is_stable(loop._replace(kv=kv)) for kv in values]
    inside = [place for place, holds in enumerate(stable) if holds]
    if not inside:
        return math.nan, math.nan
    nearest = min(inside, key=lambda place: abs(place - len(values) // 2))
    first, last = nearest, nearest
    while first > 0 and stable[first - 1]:
        first -= 1
    while last + 1 < len(stable) and stable[last + 1]:
        last += 1
    low, high = 0.0, math.inf
    if first > 0:
        low = bisect(lambda kv: not is_stable(loop._replace(kv=kv)), values[first - 1], values[first], HALVINGS)[1]
    if last + 1 < len(stable):
        high = bisect(lambda kv: is_stable(loop._replace(kv=kv)), values[last], values[last + 1], HALVINGS)[0]
    return low, high


def last_stable(
    changed: Callable[[float], SampledLoop], first: float, factor: float, end: float
) -> float:
    """Return the last value, from `first` by steps of a factor to `end`, up to which the loop is stable; NaN: none."""
    if not is_stable(changed(first)):
        return math.nan
    last = first
    while (last - end) * (factor - 1.0) < 0.0:
        following = last * factor
        if not is_stable(changed(following)):
            return bisect(lambda value: is_stable(changed(value)), last, following, HALVINGS)[0]
        last = following
    return end
