"""Where the command of a law is none, or no number, away from the goal."""

import math
from collections.abc import Iterator

import numpy as np

from bench.experiments.rows.command_field.field import NOUGHT, Field, Finding, about, after, size, uniform
from tasks.sphere import axes

AXES = 200
UNIFORM, SEARCHES, STEPS = 1500, 24, 60
NEAR_RAD, APART_RAD = math.pi / 4.0, 1e-3
"""Searches begin no nearer to the goal than the first, and have run into it, or a half turn, within the second."""


def dead_points(field: Field, seed: int) -> Iterator[Finding]:
    """Half turns where the command is none, or no number; and other states that searches run into."""
    directions = half_turn_axes()
    quats = np.column_stack((np.zeros(AXES), directions))
    u = field(quats)
    for finding, is_one in (("dead-half-turns", size(u) <= NOUGHT), ("no-number-half-turns", ~np.isfinite(size(u)))):
        yield _finding(finding, _set_of(directions, is_one), is_one, quats, u, field.gains.kp)
    ends = _searched(field, seed)
    u, angle = field(ends), 2.0 * np.arccos(np.clip(np.abs(ends[:, 0]), 0.0, 1.0))
    is_one = (size(u) <= NOUGHT) & (angle > APART_RAD) & (angle < math.pi - APART_RAD)
    yield _finding("dead-elsewhere", "some" if is_one.any() else "none", is_one, ends, u, field.gains.kp)


def _finding(finding: str, what: str, is_one: np.ndarray, quats: np.ndarray, u: np.ndarray, kp: float) -> Finding:
    """The first of these states shows it; the size is that of the largest command."""
    if not is_one.any():
        return Finding(finding, what, of=len(quats))
    largest, first = size(u[is_one]).max(), int(np.argmax(is_one))
    return Finding(finding, what, largest, found=int(is_one.sum()), of=len(quats), quat=quats[first], u=u[first] * kp)


def half_turn_axes() -> np.ndarray:
    """AXES of them: the base axes and all diagonals, 16 in each base plane, the rest spread over the sphere."""
    signs = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if (x, y, z) > (0, 0, 0)]
    angle = (np.arange(16) + 0.3) * math.pi / 16.0
    ring = np.column_stack((np.cos(angle), np.sin(angle), np.zeros(16)))
    rings = [np.roll(ring, shift, axis=1) for shift in range(3)]
    fixed = np.concatenate((np.array(signs) / np.linalg.norm(signs, axis=1)[:, None], *rings))
    return np.concatenate((fixed, axes(AXES - len(fixed))))


def _set_of(directions: np.ndarray, is_one: np.ndarray) -> str:
    """The word for the set that these of the axes form."""
    if is_one.all() or not is_one.any():
        return "every" if is_one.any() else "none"
    normal = np.linalg.svd(directions[is_one])[2][-1]
    if is_one.sum() > 3 and (is_one == (np.abs(directions @ normal) < NOUGHT)).all():
        axis = int(np.argmax(np.abs(normal)))
        return "plane-" + "xyz"[axis] if abs(normal[axis]) > 1.0 - NOUGHT else "plane"
    return "some"


def _searched(field: Field, seed: int) -> np.ndarray:
    """Where Levenberg and Marquardt's descents of |u|^2 end, from the least commands of UNIFORM orientations."""
    q, base = uniform(UNIFORM, seed), np.eye(3)
    q = q[np.abs(q[:, 0]) < math.cos(NEAR_RAD / 2.0)]
    q = q[np.argsort(size(field(q)), kind="stable")[:SEARCHES]]
    f, damping, step_rad = field(q), np.full(len(q), 1e-3), 1e-7
    for _ in range(STEPS):
        aside = field(after(about(base, step_rad)[:, None], q).reshape(-1, 4)).reshape(3, -1, 3)
        J = np.nan_to_num((aside - f) / step_rad, posinf=0.0, neginf=0.0).transpose(1, 2, 0)
        square = np.einsum("nki,nkj->nij", J, J)
        square += (damping * (np.trace(square, axis1=1, axis2=2) + 1e-12))[:, None, None] * base
        step = -np.linalg.solve(
            square, np.einsum("nki,nk->ni", J, np.nan_to_num(f, posinf=0.0, neginf=0.0))[..., None]
        )[..., 0]
        length = np.linalg.norm(step, axis=1)
        there = after(about(step / np.fmax(length, 1e-300)[:, None], np.fmin(length, 0.5)), q)
        there /= np.linalg.norm(there, axis=1)[:, None]
        g = field(there)
        better = size(g) < size(f)
        q, f = np.where(better[:, None], there, q), np.where(better[:, None], g, f)
        damping = np.clip(np.where(better, 0.1, 10.0) * damping, 1e-9, 1e6)
    return q
