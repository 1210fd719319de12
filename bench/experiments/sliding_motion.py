"""Motions of the law `sliding` in continuous time, and how they decay: experiments of claims, in no suite.

The angle to the goal is theta, T = tan(theta/4), (eta, eps) the quaternion of the turn to the goal with eta >= 0,
s = omega - lambda eps, and K the rate at which the law makes s decay.
"""

import math
from typing import NamedTuple

import numpy as np

import tasks
from bench.engines.curve import blank_curves
from bench.experiments.episodes import simulate
from bench.experiments.experiment import Settings, Unit
from bench.law.contenders.registry import regulator
from bench.law.inputs import Gains
from bench.law.kinds import Law
from tasks.base import Start

LAW = "sliding"
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.6, 0.8))
ANGLES_DEG = (60.0, 120.0, 170.0, 179.0)
STARTS_OF_A_SET = 100
SAMPLES = 1000
"""A sample a millisecond for 1 s, ten time constants at the default gains: T falls by e^-10, far above rounding."""


class Rates(NamedTuple):
    """lambda and K of the gains [1/s]."""

    surface: float
    approach: float


class Motion(NamedTuple):
    """Samples of episodes, a row an episode: time [s], T, and the nine numbers of R."""

    time: np.ndarray
    T: np.ndarray
    R: np.ndarray

    @property
    def angle(self) -> np.ndarray:
        """Return theta [rad]."""
        return 4.0 * np.arctan(self.T)


class Decay(NamedTuple):
    """Decay of bodies that start on s = 0.

    Attributes:
        starts: Number of episodes.
        largest_error: Largest relative difference of T from T(0) exp(-lambda t/2).
        first_rate: Rate of decay of sin(theta/2) at the start nearest to 180° [1/s].
        last_rate: The same at the end of that episode [1/s].
    """

    starts: int
    largest_error: float
    first_rate: float
    last_rate: float


class Bounded(NamedTuple):
    """T over its proved bound: the number of starts, and the greatest share."""

    starts: int
    largest_share: float


def rates_of(gains: Gains) -> Rates:
    """Return lambda and K of the gains; K lambda = 2 Kp where Kv^2 >= 4 Kp, as the law `sliding` has them."""
    surplus = max(0.0, gains.kv**2 / 4.0 - gains.kp)
    half = gains.kv / 2.0 - math.sqrt(surplus)
    return Rates(2.0 * half, gains.kv - half)


def error_vector(start: Start) -> np.ndarray:
    """Return eps of the turn from a start to the goal at zero rotation, base frame, on the side eta >= 0."""
    quat = np.array(start.quat_wxyz)
    return -math.copysign(1.0, quat[0]) * quat[1:]


def turn_about(axis: tuple[float, ...], angle: float) -> Start:
    """Return a start at rest, turned about an axis of length 1."""
    x, y, z = (math.sin(0.5 * angle) * part for part in axis)
    return Start("", (math.cos(0.5 * angle), x, y, z))


def follow(law: Law, starts: list[Start], gains: Gains) -> Motion:
    """Simulate starts of a law in continuous time."""
    settings = Settings(gains=gains, own=(law,))
    unit = Unit("free-body", law.name, "free-body", engine="ideal-rk4", count=len(starts))
    curves = blank_curves(len(starts), SAMPLES)
    simulate(settings, unit, starts, SAMPLES * settings.dt_s, curves)
    samples = curves.samples
    chord = np.sqrt(np.minimum(1.0, samples[:, :, 16]))
    T = chord / (1.0 + np.sqrt(1.0 - chord**2))
    return Motion(samples[:, :, 0], T, samples[:, :, 1:10])


def measure_decay(gains: Gains) -> Decay:
    """Simulate bodies that start on s = 0 and compare T with T(0) exp(-lambda t/2)."""
    surface, _ = rates_of(gains)
    turned = [turn_about(axis, math.radians(angle)) for angle in ANGLES_DEG for axis in AXES]
    starts = [start._replace(omega=tuple(surface * error_vector(start))) for start in turned]
    motion = follow(regulator(LAW), starts, gains)
    expected = motion.T[:, :1] * np.exp(-0.5 * surface * motion.time)
    error = np.abs(motion.T / expected - 1.0)
    logarithm = np.log(np.sin(0.5 * motion.angle[-1]))
    rate = -np.gradient(logarithm, motion.time[-1], edge_order=2)
    return Decay(len(starts), float(np.nanmax(error)), float(rate[0]), float(rate[-1]))


def measure_bound(gains: Gains, seed: int) -> Bounded:
    """Compare T with its bound from uniform starts, 180° rotations and spinning bodies.

    T' <= -lambda T/2 + |s|/2 for T <= 1, and |s| <= |s(0)| exp(-K t), which a change of sign only makes less. So T is
    at most exp(-lambda t/2) T(0) + |s(0)|/2 times the convolution of exp(-lambda t/2) and exp(-K t). As K >= lambda/2,
    the convolution is at most t exp(-lambda t/2); the two are equal where K = lambda/2.
    """
    starts: list[Start] = []
    for name in ("uniform", "half-turn", "tumbling"):
        starts += tasks.start_set(name, STARTS_OF_A_SET, seed)
    surface, _ = rates_of(gains)
    s = [np.linalg.norm(np.array(start.omega) - surface * error_vector(start)) for start in starts]
    motion = follow(regulator(LAW), starts, gains)
    growth = 0.5 * np.array(s)[:, None] * motion.time
    bound = (motion.T[:, :1] + growth) * np.exp(-0.5 * surface * motion.time)
    return Bounded(len(starts), float(np.nanmax(motion.T / bound)))
