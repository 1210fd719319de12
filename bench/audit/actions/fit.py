"""Fit one convention to rows of a log: v = k C u, with the motion v of a row, what the action says u, and the gain k.

C is a constant rotation between two frames, the identity if nothing is wrong. Rows that do not fit count less and less,
so that a part of the log that means something else does not spoil the rest.
"""

from typing import NamedTuple

import numpy as np

from bench.audit.actions.conventions import COORDINATES, REPRESENTATIONS
from bench.audit.rotations import exp, log

TOLERANCE, MOVES = 0.2, 0.25
"""A row is explained to this part of its motion, or of the log's rms motion; it is judged if it moves so far of it."""


class LogRows(NamedTuple):
    """Rows of a log: before, R, R_next (n x 3 x 3), one step apart; action (n x m); at: row of R; tolerance [rad]."""

    before: np.ndarray
    R: np.ndarray
    R_next: np.ndarray
    action: np.ndarray
    at: np.ndarray
    tolerance: np.ndarray

    def chosen(self, which: np.ndarray | slice) -> "LogRows":
        """Return some of the rows."""
        return LogRows(*(field[which] for field in self))


def align(
    R: np.ndarray, R_next: np.ndarray, action: np.ndarray, episode: np.ndarray, lag: int
) -> LogRows:
    """Return the rows where action t moves pose t + lag of the same episode, if they move."""
    t = np.arange(max(-lag, 0), len(R) - max(lag, 0))
    t = t[episode[t] == episode[t + lag]]
    at = t + lag
    before = np.where((at > 0) & (episode[at - 1] == episode[at]), at - 1, at)
    motion = np.linalg.norm(log(R[at].swapaxes(1, 2) @ R_next[at]), axis=1)
    rms = np.sqrt((motion**2).sum() / max(len(t), 1))
    tolerance = TOLERANCE * np.maximum(motion, rms) + 1e-12
    return LogRows(R[before], R[at], R_next[at], action[t], at, tolerance).chosen(
        motion > MOVES * rms
    )


class ActionConvention(NamedTuple):
    """A candidate; gain (k) and turn (C) are fitted.

    unit: rad for 1 in the action, before it is decoded; clip: "component" or "norm", at bound, before that; follows:
    gain towards a target, 0 if deltas start from poses; offset: where C is, the "frame" of a delta, or the "tool" (A C)
    or "base" (C A) of an absolute one.
    """

    pose: str
    representation: str
    relation: str
    lag: int = 0
    unit: float = 1.0
    is_inverse: bool = False
    offset: str = ""
    clip: str = ""
    bound: float = np.inf
    follows: float = 0.0
    gain: float = 0.0
    turn: np.ndarray = np.eye(3)

    @property
    def extras(self) -> int:
        """Count of its parameters beyond the gain: constant rotation, clip, target."""
        return bool(self.offset) + bool(self.clip) + bool(self.follows)

    @property
    def suspicion(self) -> int:
        """Count of what would be a fault, to prefer the plainest of conventions that explain a log alike."""
        return (self.lag != 0) + (self.relation == "difference") + self.is_backward

    @property
    def is_backward(self) -> bool:
        """Tell whether the robot turns the other way; poses that are read transposed look so, with base for body."""
        return self.is_inverse or self.gain < 0.0


def fit(
    rows: LogRows, one: ActionConvention, rounds: int = 5
) -> tuple[ActionConvention, np.ndarray]:
    """Return the convention with its gain and constant rotation, and the residual (n) of every row [rad]."""
    R, R_next, C, size = rows.R, rows.R_next, np.eye(3), np.linalg.norm(rows.action, axis=1, keepdims=True)
    a = np.clip(rows.action, -one.bound, one.bound) if one.clip == "component" else rows.action
    a = a * np.minimum(1.0, one.bound / np.maximum(size, 1e-300)) if one.clip == "norm" else a
    if one.relation == "difference":
        c = COORDINATES[one.representation]
        v, u = np.remainder(c(R_next) - c(R) + np.pi, 2.0 * np.pi) - np.pi, a
    elif one.relation == "absolute":
        A = REPRESENTATIONS[a.shape[1]][one.representation](one.unit * a)
        A = A.swapaxes(1, 2) if one.is_inverse else A
        v, u, goal = log(R.swapaxes(1, 2) @ R_next), log(R.swapaxes(1, 2) @ A), R_next
        for _ in range(
            0 if not one.offset else 3 if rounds else 1
        ):  # a pose is only part of the way to its goal: C, the gain, and again
            C = nearest((A.swapaxes(1, 2) @ goal if one.offset == "tool" else goal @ A.swapaxes(1, 2)).mean(axis=0))
            u = log(R.swapaxes(1, 2) @ (A @ C if one.offset == "tool" else C @ A))
            goal = R @ exp(v / max(regress(v, u, rows.tolerance, rounds)[0], 0.2))
    else:
        if one.follows:  # the target of a step, seen from how far the pose went towards it
            R_next = R @ exp(log(R.swapaxes(1, 2) @ R_next) / one.follows)
            R = rows.before @ exp(log(rows.before.swapaxes(1, 2) @ R) / one.follows)
        v = log(R_next @ R.swapaxes(1, 2) if one.relation == "base" else R.swapaxes(1, 2) @ R_next)
        u = log(REPRESENTATIONS[a.shape[1]][one.representation](one.unit * a))
    share = one.follows or 1.0
    gain, turn = regress(v, u, rows.tolerance / share, rounds, one.offset == "frame")
    residual = share * np.linalg.norm(v - gain * u @ turn.T, axis=1)
    return one._replace(gain=gain, turn=turn if one.offset == "frame" else C), residual


def nearest(M: np.ndarray, is_signed: bool = False) -> np.ndarray:
    """Return the rotation C nearest to a matrix (Kabsch), or to it or its negative, whichever is nearer to one."""
    U, _, Vt = np.linalg.svd(M)
    sign = np.sign(np.linalg.det(U @ Vt))
    return sign * U @ Vt if is_signed else U @ np.diag((1.0, 1.0, sign)) @ Vt


def regress(
    v: np.ndarray, u: np.ndarray, tolerance: np.ndarray, rounds: int, is_turned: bool = False
) -> tuple[float, np.ndarray]:
    """Return k and C of v = k C u (n x 3), by weights 1/(1 + (r/s)^2)^2, with s from 8 tolerances down to 1 in rounds.

    It starts from the quartile of the rows' gains that leaves the least, so that half of them may be wrong.
    """
    C, square = nearest(v.T @ u, is_signed=True) if is_turned else np.eye(3), np.maximum((u * u).sum(axis=1), 1e-300)
    starts = np.quantile((v * (u @ C.T)).sum(axis=1) / square, (0.25, 0.5, 0.75))
    gain = min(starts, key=lambda k: np.minimum(np.linalg.norm(v - k * u @ C.T, axis=1) / tolerance, 1.0).sum())
    for times in (8.0, 4.0, 2.0, 1.0, 1.0)[:rounds]:
        weight = 1.0 / (1.0 + (((v - gain * u @ C.T) / (times * tolerance)[:, None]) ** 2).sum(axis=1)) ** 2
        C = nearest((weight[:, None] * v).T @ u, is_signed=True) if is_turned else C
        gain = (weight * (v * (u @ C.T)).sum(axis=1)).sum() / max((weight * square).sum(), 1e-300)
    return float(gain), C
