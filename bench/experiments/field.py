"""A law as a field of commands u(R, omega), evaluated by the compiled loop."""

import numpy as np

from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.episode import Settings, numbers
from bench.engines.metrics.registry import metrics_of
from bench.law.contender import Contender
from bench.law.inputs import Gains
from tasks.base import IDENTITY, Quat

ENGINE, U = "ideal-held", NUMBERS.index("u_x")

ZERO = 1e-9
"""|u|/kp below which a command counts as zero: it moves a body 2e-5 rad in the longest horizon, 20 s."""


class CommandField:
    """u(R, omega) of a law with its initial memory, by the compiled loop: its first sample of an episode."""

    def __init__(self, one: Contender, gains: Gains):
        self.one, self.gains, self.metrics = one, gains, tuple(metrics_of(on_arm=False))

    def __call__(self, quats: np.ndarray, goal: Quat = IDENTITY, omegas: np.ndarray | float = 0.0) -> np.ndarray:
        """Return u/kp of n quaternions (n, 4) and angular velocities (n, 3)."""
        from bench.engines.simulate import by_law

        starts, curves = np.ones((len(quats), 12)), blank_curves(len(quats), 1)
        starts[:, :4], starts[:, 4:7], starts[:, 7:11] = quats, omegas, goal
        given = numbers(Settings(self.gains, 0.001, 1, 2))
        by_law(ENGINE, self.one, starts, given, self.metrics, curves)
        return curves.samples[:, 0, U : U + 3] / self.gains.kp


def about(axis: np.ndarray, angle: np.ndarray | float) -> np.ndarray:
    """Return quaternions of rotations about unit axes (..., 3)."""
    half = 0.5 * np.broadcast_to(angle, axis.shape[:-1])[..., None]
    return np.concatenate((np.cos(half), np.sin(half) * axis), axis=-1)


def size(u: np.ndarray) -> np.ndarray:
    """Return lengths of commands; infinite where one is no number."""
    lengths = np.linalg.norm(u, axis=-1)
    return np.where(np.isfinite(lengths), lengths, np.inf)
