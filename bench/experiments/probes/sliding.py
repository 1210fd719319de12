"""Motions of the law `sliding` in continuous time: its decay, its bound, its second frame, and noise at 180°.

The angle to the goal is theta, T = tan(theta/4), (eta, eps) the quaternion of the turn to the goal with eta >= 0,
s = omega - lambda eps, and K the rate at which the law makes s decay.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

import tasks
from bench.engines.curve import blank_curves
from bench.engines.episode import Settings as Limits
from bench.engines.metrics.registry import metrics_of
from bench.experiments.episode_rows import judged_columns
from bench.experiments.experiment import Unit
from bench.experiments.probe_values.sliding import (
    LAW,
    NOISE_SHARE,
    PERIODS_S,
    STARTS_OF_A_SET,
    WITH_MEMORY,
)
from bench.experiments.probes.number import Number
from bench.experiments.request import Request
from bench.law.contender import Contender
from bench.law.contenders.registry import find_contender, regulator
from bench.law.inputs import Gains
from bench.law.kinds import Law
from tasks.base import Start
from tasks.condition import Condition

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.6, 0.8))
ANGLES_DEG = (60.0, 120.0, 170.0, 179.0)
SAMPLES = 1000
"""A sample a millisecond for 1 s, ten time constants at the default gains: T falls by e^-10, far above rounding."""

NOISE_S = 2.0
"""Horizon under noise [s]."""


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


def has_sliding_variable(gains: Gains) -> bool:
    """Tell whether the gains have real poles, without which the law has no sliding variable."""
    return gains.kv**2 >= 4.0 * gains.kp


def rates_of(gains: Gains) -> Rates:
    """Return lambda and K of the gains; K lambda = 2 Kp where Kv^2 >= 4 Kp, as the law `sliding` has them."""
    surplus = max(0.0, gains.kv**2 / 4.0 - gains.kp)
    half = gains.kv / 2.0 - math.sqrt(surplus)
    return Rates(2.0 * half, gains.kv - half)


def error_vector(start: Start) -> np.ndarray:
    """Return eps of the turn from a start to the goal at zero rotation, base frame, on the side eta >= 0."""
    quat = np.array(start.quat_wxyz)
    return -math.copysign(1.0, quat[0]) * quat[1:]


def turn_about(
    axis: tuple[float, ...], angle: float, name: str = ""
) -> Start:
    """Return a start at rest, turned about an axis of length 1."""
    x, y, z = (math.sin(0.5 * angle) * part for part in axis)
    return Start(name, (math.cos(0.5 * angle), x, y, z))


def follow(law: Law, starts: list[Start], gains: Gains) -> Motion:
    """Simulate starts of a law in continuous time."""
    from bench.engines.simulate import run

    request = Request(gains=gains)
    curves = blank_curves(len(starts), SAMPLES)
    run(
        "ideal-rk4",
        Contender(law),
        "free-body",
        starts,
        request.limits(SAMPLES * request.dt_s),
        metrics_of(on_arm=False),
        curves=curves,
    )
    samples = curves.samples
    chord = np.sqrt(np.minimum(1.0, samples[:, :, 16]))
    T = chord / (1.0 + np.sqrt(1.0 - chord**2))
    return Motion(samples[:, :, 0], T, samples[:, :, 1:10])


def measure_decay(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield how far T is from T(0) exp(-lambda t/2) of bodies that start on s = 0; at: the first angle [degrees].

    Also the rate at which sin(theta/2) decays, at the beginning and at the end [1/s].
    """
    gains, words = request.gains, find_contender(LAW).words
    surface, _ = rates_of(gains)
    places = [
        (angle, axis) for angle in ANGLES_DEG for axis in range(len(AXES))
    ]
    starts = []
    for angle, axis in places:
        start = turn_about(
            AXES[axis], math.radians(angle), f"{angle:g}-axis-{axis}"
        )
        starts.append(
            start._replace(omega=tuple(surface * error_vector(start)))
        )
    motion = follow(regulator(LAW), starts, gains)
    expected = motion.T[:, :1] * np.exp(-0.5 * surface * motion.time)
    errors = np.nanmax(np.abs(motion.T / expected - 1.0), axis=1)
    for k, (angle, _) in enumerate(places):
        logarithm = np.log(np.sin(0.5 * motion.angle[k]))
        rate = -np.gradient(logarithm, motion.time[k], edge_order=2)
        name = starts[k].id
        yield Number(
            "decay_gap", float(errors[k]), name, angle, words=words
        )
        yield Number(
            "first_rate_per_s", float(rate[0]), name, angle, words=words
        )
        yield Number(
            "last_rate_per_s", float(rate[-1]), name, angle, words=words
        )


def measure_bound(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the greatest share of T in its bound, from uniform starts, 180° rotations and spinning bodies.

    T' <= -lambda T/2 + |s|/2 for T <= 1, and |s| <= |s(0)| exp(-K t), which a change of sign only makes less. So T is
    at most exp(-lambda t/2) T(0) + |s(0)|/2 times the convolution of exp(-lambda t/2) and exp(-K t). As K >= lambda/2,
    the convolution is at most t exp(-lambda t/2); the two are equal where K = lambda/2.
    """
    starts: list[Start] = []
    for name in ("uniform", "half-turn", "tumbling"):
        starts += tasks.start_set(name, STARTS_OF_A_SET, request.seed)
    surface, _ = rates_of(request.gains)
    s = []
    for start in starts:
        s.append(
            np.linalg.norm(
                np.array(start.omega) - surface * error_vector(start)
            )
        )
    motion = follow(regulator(LAW), starts, request.gains)
    growth = 0.5 * np.array(s)[:, None] * motion.time
    bound = (motion.T[:, :1] + growth) * np.exp(
        -0.5 * surface * motion.time
    )
    shares = np.nanmax(motion.T / bound, axis=1)
    words = find_contender(LAW).words
    for start, share in zip(starts, shares.tolist(), strict=True):
        yield Number("share_of_bound", share, start.id, words=words)


def measure_frames(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield how far motions of the law in the base frame and in the body frame differ at one time, at most [rad].

    From the same starts, at rest (uniform) and spinning (tumbling): of the angles to the goal, and of the orientations.
    """
    # Imported here: it builds on another law's file, and a plan is made without laws.
    from bench.experiments.probes.body_frame import IN_BODY_FRAME

    words = find_contender(LAW).words
    for name in ("uniform", "tumbling"):
        starts = tasks.start_set(name, STARTS_OF_A_SET, request.seed)
        base = follow(regulator(LAW), starts, request.gains)
        body = follow(IN_BODY_FRAME, starts, request.gains)
        gaps = np.nanmax(np.abs(base.angle - body.angle), axis=1)
        # The chord |R_1 - R_2| = sqrt(8) sin(angle/2) keeps its digits where the trace loses them.
        chords = np.nanmax(
            np.linalg.norm(base.R - body.R, axis=2), axis=1
        ) / math.sqrt(8.0)
        apart = 2.0 * np.arcsin(np.minimum(1.0, chords))
        for k, start in enumerate(starts):
            yield Number("angle_gap", float(gaps[k]), start.id, words=words)
            yield Number(
                "orientation_gap", float(apart[k]), start.id, words=words
            )


def measure_noise(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the noise of episodes from exact 180° rotations [rad] and how they end; at: the control period [s].

    In one control period the command 2 Kp turns a body at rest by Kp period^2: a smaller noise cannot turn it back.
    """
    for period_s in PERIODS_S:
        yield from hold(request, period_s, NOISE_SHARE)


def hold(
    request: Request, period_s: float, share: float
) -> Iterator[Number]:
    """Simulate exact 180° rotations with a noise of share Kp period^2, without memory and with it."""
    from bench.engines.simulate_bodies import run_disturbed

    starts = [
        turn_about(axis, math.pi, f"axis-{i}")
        for i, axis in enumerate(AXES)
    ]
    limits = Limits(request.gains, 1e-6, round(1e6 * NOISE_S), 1)
    noise = share * request.gains.kp * period_s**2
    condition = Condition(worst_attitude_error=noise, period_s=period_s)
    for law in (LAW, WITH_MEMORY):
        contender = find_contender(law)
        numbers = run_disturbed(
            contender, starts, condition, limits, metrics_of(on_arm=False)
        )
        outcomes = judged_columns(numbers, period_s)["outcome"]
        for start, outcome in zip(starts, outcomes, strict=True):
            yield Number(
                "noise_rad",
                noise,
                start.id,
                period_s,
                outcome,
                contender.words,
            )
