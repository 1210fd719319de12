"""A law near its goal: whether it rests there, its stiffness and damping against those set, and how its episodes end.

Stiffness and damping are also taken at two goals whose matrices are not symmetric: there a command in another frame, or
a matrix read row first, differs from what is meant.
"""

import math
from collections.abc import Iterator

import numpy as np

from bench.experiments.rows.command_field.field import (
    NOUGHT,
    OMEGA,
    SAME,
    Field,
    Finding,
    U,
    about,
    after,
    size,
    uniform,
)
from bench.law.so3 import from_quaternion
from tasks.base import IDENTITY

GOALS = (IDENTITY, (0.8, 0.2, 0.4, 0.4), (0.4, -0.8, 0.4, 0.2))
"""The last two lie off the singular sets of all our coordinates."""

TURN_RAD, RATE = 1e-4, 1e-3
"""Of central differences: their error is under 1e-8, rounding leaves 1e-12."""

BOUNDED = 1e3
"""Share of a gain: above it there is no stiffness, but a jump or a pole at the goal."""

STARTS, TICKS, TAIL = 20, 3000, 250
"""At the paper's gains 3 s, 30 of their time constants, and the last 0.25 s of them."""

QUIET, STILL, CLOSE_RAD = 1e-3, 1e-2, 0.05
"""At rest a command changes by less than QUIET kp a tick, a body is slower than STILL sqrt(kp), and near its goal."""


def near_goal(field: Field) -> Iterator[Finding]:
    """Whether it rests at the goal; stiffness and damping; the slowest decay of small errors."""
    base, gains = np.eye(3), field.gains
    at = [field(np.array([goal]), goal)[0] for goal in GOALS]
    sizes = size(np.array(at))
    worst = int(np.argmax(sizes))
    what = "rests" if sizes[worst] <= NOUGHT else "pushes" if np.isfinite(sizes[worst]) else "no-number"
    yield Finding("goal", what, sizes[worst], quat=GOALS[worst], goal=GOALS[worst], u=at[worst] * gains.kp)
    K, D = [], []
    for goal in GOALS:
        up, down = (field(after(about(base, sign * TURN_RAD), np.array(goal)), goal) for sign in (1.0, -1.0))
        K.append((down - up).T / (2.0 * TURN_RAD))
        beside = after(about(np.array([[0.6, 0.0, 0.8]] * 3), TURN_RAD), np.array(goal))
        up, down = (field(beside, goal, sign * RATE * base) for sign in (1.0, -1.0))
        D.append((down - up).T * gains.kp / (2.0 * RATE * gains.kv))
    yield _compared("stiffness", K, field.one.regulator.stiffness)
    yield _compared("damping", D, (1.0, 1.0, 1.0))
    rates = [_slowest(gains.kp * k, gains.kv * d) for k, d in zip(K, D, strict=True)]
    least = int(np.argmin(rates))
    what = "decays" if rates[least] > STILL * math.sqrt(gains.kp) else "does-not-decay"
    yield Finding("small-error", what if np.isfinite(rates[least]) else "unknown", rates[least], goal=GOALS[least])


def _slowest(K: np.ndarray, D: np.ndarray) -> float:
    """The least rate [1/s] at which a small error decays: delta' = omega, omega' = -K delta - D omega."""
    if not np.isfinite((K, D)).all():
        return -math.inf
    return float(-np.linalg.eigvals(np.block([[np.zeros((3, 3)), np.eye(3)], [-K, -D]])).real.max())


def _compared(finding: str, found: list[np.ndarray], declared: tuple) -> Finding:
    """What the matrices found at GOALS are of what they should be, R_d diag(declared) R_d^T."""
    turns = [np.array(from_quaternion(goal)).T for goal in GOALS]
    wanted = np.array([R @ np.diag(declared) @ R.T for R in turns])
    matrices = np.array(found)
    spread = [np.linalg.svd(one, compute_uv=False) for one in np.nan_to_num(matrices, posinf=0.0, neginf=0.0)]
    off = np.nan_to_num(np.abs(matrices - wanted).max(axis=(1, 2)), nan=np.inf)
    worst = int(np.argmax(off))
    shown = {"least": spread[worst][-1], "most": spread[worst][0], "goal": GOALS[worst]}
    if off[worst] > BOUNDED:
        return Finding(finding, "unbounded", **shown)
    if np.abs(matrices).max() < SAME:
        return Finding(finding, "none", 0.0, **shown)
    for frame, frames in {"": [np.eye(3)] * 3, "transposed": [R.T for R in turns], "turned": turns}.items():
        expected = np.array([M @ want for M, want in zip(frames, wanted, strict=True)])
        share = float(np.sum(expected * matrices) / np.sum(expected * expected))
        if np.abs(matrices - share * expected).max() < SAME * abs(share):
            if frame:
                shown["goal"] = GOALS[-1]  # at I all frames are one
            return Finding(finding, _called(frame, share), share, **shown)
    return Finding(finding, "uneven" if off[0] > SAME else "uneven-elsewhere", **shown)


def _called(frame: str, share: float) -> str:
    """The word for a matrix that is this share of what it should be, in this frame."""
    if frame:
        return "turned-by-goal" if frame == "turned" else "body-frame" if share > 0.0 else "row-first"
    near = {"as-set": 1.0, "half": 0.5, "wrong-sign": -1.0}
    known = (word for word, wanted in near.items() if abs(share - wanted) < 0.01)
    return next(known, "scaled" if share > 0.0 else "wrong-sign")


def rest(field: Field, seed: int) -> Finding:
    """How it ends from STARTS spread over SO(3): quiet, chattering at the goal, or on the move, few of them or most."""
    quats, root = uniform(STARTS, seed), math.sqrt(field.gains.kp)
    tail = field.simulated(quats, TICKS)[:, -TAIL:]
    change = np.linalg.norm(np.diff(tail[:, :, U], axis=1), axis=2).mean(axis=1) / field.gains.kp
    speed = np.linalg.norm(tail[:, :, OMEGA], axis=2).max(axis=1) / root
    angle = 2.0 * np.arcsin(np.sqrt(np.clip(tail[:, :, -1].max(axis=1), 0.0, 1.0)))
    ends = {"chatters": (change > QUIET) & (angle < CLOSE_RAD), "moves": speed > STILL, "breaks-off": np.isnan(change)}
    for what, is_one in ends.items():
        if is_one.any():
            worst, found = int(np.argmax(np.where(is_one, np.nan_to_num(change), -1.0))), int(is_one.sum())
            word = "late" if what == "moves" and 2 * found < STARTS else what
            told = {"least": angle[worst], "most": speed[worst], "quat": quats[worst]}
            return Finding("rest", word, change[worst], found=found, of=STARTS, **told)
    return Finding("rest", "quiet", change.max(), of=STARTS)
