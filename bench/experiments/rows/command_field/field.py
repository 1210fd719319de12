"""The command of a law in many states at once, and one finding of it."""

import math
from typing import NamedTuple

import numpy as np

import tasks
from bench.engines.binding import memory_of
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.episode import Settings, blank, numbers
from bench.engines.run import compiled_loop, evaluation
from bench.law.contender import Contender, Gains
from bench.metrics.registry import metrics_of
from tasks.base import IDENTITY, Quat

ENGINE = "ideal-held"

TICK = 0.01
"""Control period in 1/sqrt(kp): 1 ms at the paper's gains."""

SAME = 1e-3
"""Share by which a stiffness, or a pull, may differ from what it is taken for."""

NOUGHT = 1e-9
"""|u|/kp below which a command is none: it moves a body 2e-5 rad in the longest horizon, 20 s."""

U, OMEGA = (slice(first := NUMBERS.index(name), first + 3) for name in ("u_x", "omega_x"))
"""Of a sample."""


class Finding(NamedTuple):
    """One row: what was found of what, its size, in how many states of how many, and the state that shows it."""

    finding: str
    what: str
    value: float = math.nan
    least: float = math.nan
    most: float = math.nan
    found: int = 0
    of: int = 0
    quat: np.ndarray | tuple = (math.nan,) * 4
    goal: Quat = IDENTITY
    u: np.ndarray | tuple = (math.nan,) * 3


class Field:
    """u(R, omega) of a law with its initial memory, by the compiled loop: its first sample of an episode."""

    def __init__(self, one: Contender, gains: Gains):
        self.one, self.gains, self.metrics = one, gains, tuple(metrics_of(on_arm=False))
        self.law = evaluation(one), memory_of(one)

    def __call__(self, quats: np.ndarray, goal: Quat = IDENTITY, omegas: np.ndarray | float = 0.0) -> np.ndarray:
        """u/kp of n quaternions (n, 4) and angular velocities (n, 3)."""
        return self.simulated(quats, 1, goal, omegas)[:, 0, U] / self.gains.kp

    def simulated(self, quats, ticks: int, goal: Quat = IDENTITY, omegas: np.ndarray | float = 0.0) -> np.ndarray:
        """Samples of every tick, as `engines.curve` has them; NaN from where an episode has broken off."""
        starts = np.ones((len(quats), 12))
        starts[:, :4], starts[:, 4:7], starts[:, 7:11] = quats, omegas, goal
        curves = blank_curves(len(quats), ticks)
        given = numbers(Settings(self.gains, TICK / math.sqrt(self.gains.kp), ticks, ticks + 1))
        compiled_loop(ENGINE, self.metrics)(*self.law, starts, given, blank(len(quats), self.metrics), curves)
        return curves.samples


def about(axis: np.ndarray, angle: np.ndarray | float) -> np.ndarray:
    """Quaternions of turns about unit axes (..., 3)."""
    half = 0.5 * np.broadcast_to(angle, axis.shape[:-1])[..., None]
    return np.concatenate((np.cos(half), np.sin(half) * axis), axis=-1)


def after(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """p q: the turn q, then p in the base frame."""
    (pw, pv), (qw, qv) = ((x[..., :1], x[..., 1:]) for x in (p, q))
    w = pw * qw - np.sum(pv * qv, axis=-1, keepdims=True)
    return np.concatenate((w, pw * qv + qw * pv + np.cross(pv, qv)), axis=-1)


def size(u: np.ndarray) -> np.ndarray:
    """Lengths of commands; infinite where one is no number."""
    lengths = np.linalg.norm(u, axis=-1)
    return np.where(np.isfinite(lengths), lengths, np.inf)


def uniform(count: int, seed: int) -> np.ndarray:
    """Quaternions spread over SO(3): the judge's starts (count, 4)."""
    return np.array([start.quat_wxyz for start in tasks.starts_between("uniform", 0, count, seed)])
