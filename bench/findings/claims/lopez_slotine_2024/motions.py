"""Episodes that the claims of Lopez and Slotine compute: decay, both frames, and smaller noise at 180°.

The angle to the goal is theta, T = tan(theta/4), (eta, eps) the quaternion of the turn to the goal with eta >= 0,
s = omega - lambda eps, and K the rate at which the law makes s decay.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

import tasks
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.episode import Settings as Limits
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate_bodies import run_disturbed
from bench.experiments.episode_rows import episode_columns
from bench.experiments.episodes import simulate
from bench.experiments.experiment import Settings, Unit
from bench.findings.claims.lopez_slotine_2024.body_frame import IN_BODY_FRAME
from bench.findings.claims.probes import about
from bench.findings.proofs.certificate import read_certificates
from bench.law.contenders.registry import find_contender
from bench.law.contenders.regulators import sliding
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.condition import Condition

LAW, WITH_MEMORY = "sliding", "sliding-memory"
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 1.0))
ANGLES_DEG = (60.0, 120.0, 170.0, 179.0)
STARTS_OF_A_SET = 100
SECONDS = 1.0
"""Ten time constants at the default gains: T falls by e^-10, and rounding of theta near zero is still far below T."""


class Rates(NamedTuple):
    """lambda and K of the gains [1/s]."""

    surface: float
    approach: float


class Motion(NamedTuple):
    """Samples of all episodes, a row an episode: time [s], T = tan(theta/4), and orientation (n, o, a as rows)."""

    time: np.ndarray
    T: np.ndarray
    orientation: np.ndarray

    @property
    def angle(self) -> np.ndarray:
        """Return theta [rad]."""
        return 4.0 * np.arctan(self.T)


class Decay(NamedTuple):
    """Decay of bodies that start on s = 0.

    Attributes:
        starts: Number of episodes.
        largest_error: Largest relative difference of T from T(0) exp(-lambda t/2).
        first_rate: Rate of decay of the chord sin(theta/2) at the start nearest to 180° [1/s].
        last_rate: The same at the end of that episode [1/s].
    """

    starts: int
    largest_error: float
    first_rate: float
    last_rate: float


class Bounded(NamedTuple):
    """T over its proved bound, from starts of any rate.

    Attributes:
        starts: Number of episodes.
        fastest: Greatest initial rate [rad/s].
        largest_share: Greatest T over the bound.
    """

    starts: int
    fastest: float
    largest_share: float


class Frames(NamedTuple):
    """The law in the base frame and in the body frame, from the same starts.

    Attributes:
        starts: Number of starts: at rest and spinning.
        largest_angle_gap: Greatest difference of the angles to the goal at one time [rad].
        apart_at_rest: Greatest angle between the two orientations at one time, of starts at rest [rad].
        apart_spinning: The same of spinning starts [rad].
    """

    starts: int
    largest_angle_gap: float
    apart_at_rest: float
    apart_spinning: float


class Hold(NamedTuple):
    """Episodes from exact 180° rotations with worst-case noise, of one law at one control period.

    Attributes:
        law: Name of the law.
        period_s: Control period [s].
        noise_rad: Noise [rad].
        held: Episodes that do not settle.
        starts: Number of episodes.
    """

    law: str
    period_s: float
    noise_rad: float
    held: int
    starts: int


def rates_of(gains: Gains) -> Rates:
    """Return lambda and K that the law `sliding` has at these gains; K lambda = 2 Kp where Kv^2 >= 4 Kp."""
    surface = 2.0 * sliding.half_lambda(*gains)
    return Rates(surface, gains.kv - 0.5 * surface)


def error_vector(start: Start) -> np.ndarray:
    """Return eps of the turn from a start to the goal at zero rotation, base frame, on the side eta >= 0."""
    quat = np.array(start.quat_wxyz)
    return -math.copysign(1.0, quat[0]) * quat[1:]


def follow(law: str, starts: list[Start], gains: Gains) -> Motion:
    """Simulate starts in continuous time and return a sample for each millisecond."""
    settings = Settings(gains=gains, own=(IN_BODY_FRAME,))
    unit = Unit("free-body", law, "free-body", engine="ideal-rk4", count=len(starts), horizon_s=SECONDS)
    curves = blank_curves(len(starts), round(SECONDS / settings.dt_s), 1)
    simulate(settings, unit, starts, SECONDS, curves)
    samples = curves.samples
    chord = np.sqrt(np.minimum(1.0, samples[:, :, NUMBERS.index("haversine")]))
    T = chord / (1.0 + np.sqrt(1.0 - chord**2))
    return Motion(samples[:, :, 0], T, samples[:, :, 1:10])


def measure_decay(gains: Gains) -> Decay:
    """Simulate bodies that start on s = 0 and compare T with T(0) exp(-lambda t/2)."""
    rates = rates_of(gains)
    starts = []
    for angle_deg in ANGLES_DEG:
        for axis in AXES:
            rest = Start("", about(axis, math.radians(angle_deg)))
            omega = rates.surface * error_vector(rest)
            starts.append(rest._replace(omega=tuple(omega.tolist())))
    motion = follow(LAW, starts, gains)
    expected = motion.T[:, :1] * np.exp(-0.5 * rates.surface * motion.time)
    chord = np.sin(0.5 * motion.angle[-1])
    decay = -np.gradient(np.log(chord), motion.time[-1], edge_order=2)
    error = np.abs(motion.T / expected - 1.0)
    return Decay(len(starts), float(np.nanmax(error)), float(decay[0]), float(decay[-2]))


def measure_bound(gains: Gains, seed: int) -> Bounded:
    """Compare T with its bound from uniform starts, 180° rotations and spinning bodies.

    T' <= -lambda T/2 + |s|/2 for T <= 1, and |s| <= |s(0)| exp(-K t), which a change of sign only makes less. So T is
    at most exp(-lambda t/2) T(0) + |s(0)|/2 times the convolution of exp(-lambda t/2) and exp(-K t).
    """
    starts: list[Start] = []
    for name in ("uniform", "half-turn", "tumbling"):
        starts += tasks.start_set(name, STARTS_OF_A_SET, seed)
    surface, approach = rates_of(gains)
    omegas = np.array([start.omega for start in starts])
    errors = np.array([error_vector(start) for start in starts])
    s = np.linalg.norm(omegas - surface * errors, axis=1)
    motion = follow(LAW, starts, gains)
    decay = np.exp(-0.5 * surface * motion.time)
    difference = approach - 0.5 * surface
    if difference > 0.0:
        convolution = (decay - np.exp(-approach * motion.time)) / difference
    else:
        convolution = motion.time * decay
    bound = motion.T[:, :1] * decay + 0.5 * s[:, None] * convolution
    fastest = np.linalg.norm(omegas, axis=1).max()
    return Bounded(len(starts), float(fastest), float(np.nanmax(motion.T / bound)))


def compare_frames(gains: Gains, seed: int) -> Frames:
    """Simulate the law in both frames from the same starts, at rest and spinning."""
    gaps, apart = [], []
    for name in ("uniform", "tumbling"):
        starts = tasks.start_set(name, STARTS_OF_A_SET, seed)
        base = follow(LAW, starts, gains)
        body = follow(IN_BODY_FRAME.name, starts, gains)
        gaps.append(float(np.nanmax(np.abs(base.angle - body.angle))))
        # The chord |R_1 - R_2| = sqrt(8) sin(angle/2) keeps its digits where the trace loses them.
        chord = np.linalg.norm(base.orientation - body.orientation, axis=2) / math.sqrt(8.0)
        apart.append(float(2.0 * np.arcsin(np.nanmax(np.minimum(1.0, chord)))))
    return Frames(2 * STARTS_OF_A_SET, max(gaps), apart[0], apart[1])


def hold_by_noise(gains: Gains, periods_s: Sequence[float], share: float) -> list[Hold]:
    """Simulate exact 180° rotations with a noise of share Kp period^2, without memory and with it.

    In one control period the command 2 Kp turns a body at rest by Kp period^2: a smaller noise cannot turn it back.
    """
    starts = [Start("", about(axis, math.pi)) for axis in AXES]
    limits = Limits(gains, 1e-6, 2_000_000, 1)
    metrics = metrics_of(on_arm=False)
    holds = []
    for period_s in periods_s:
        noise = share * gains.kp * period_s**2
        condition = Condition(worst_attitude_error=noise, period_s=period_s)
        for law in (LAW, WITH_MEMORY):
            numbers = run_disturbed(find_contender(law), starts, condition, limits, metrics)
            rows = episode_columns(Settings(gains=gains), starts, numbers, period_s, 2.0)
            held = sum(outcome != "settled" for outcome in rows["outcome"])
            holds.append(Hold(law, period_s, noise, held, len(starts)))
    return holds


def read_proof(law: str) -> str:
    """Return what `bench prove` proved of a law, as 'global with memory'; nothing if it proved nothing."""
    certificate = read_certificates().get(law, {})
    return certificate.get("stands", "") if certificate.get("is_proved") else ""
