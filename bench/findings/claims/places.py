"""Find where starts, goals and samples of tables lie: Euler angles, distances from poles, jumps and 180°."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.probe_values.commands import EXACT_RAD
from bench.experiments.tables.run import require_rows

QUAT = ("quat_w", "quat_x", "quat_y", "quat_z")
GOAL_QUAT = tuple(f"goal_{name}" for name in QUAT)
OMEGA = ("omega0_x", "omega0_y", "omega0_z")


def euler_angles_along(trace: pd.DataFrame) -> np.ndarray:
    """Return alpha, beta, gamma of each sample of a trace, n x 3, from the columns of R as `zyx_euler.chart` has it."""
    elements = [f"{column}_{axis}" for column, axis in itertools.product("noa", "xyz")]
    n, o, a = trace[elements].to_numpy(float).T.reshape(3, 3, -1)
    level = np.sqrt(n[0] * n[0] + n[1] * n[1])
    is_off_pole = level > 0.0
    over = np.where(is_off_pole, level, 1.0)
    sine = np.where(is_off_pole, n[1] / over, 0.0)
    cosine = np.where(is_off_pole, n[0] / over, 1.0)
    alpha = np.where(is_off_pole, np.arctan2(n[1], n[0]), 0.0)
    beta = np.arctan2(-n[2], level)
    gamma = np.arctan2(sine * a[0] - cosine * a[1], cosine * o[1] - sine * o[0])
    return np.stack([alpha, beta, gamma], axis=1)


def matrices_of(angles: np.ndarray) -> np.ndarray:
    """Return R = R_z(alpha) R_y(beta) R_x(gamma) of each row alpha, beta, gamma [rad]: n x 3 to n x 3 x 3."""
    (ca, cb, cg), (sa, sb, sg) = np.cos(angles).T, np.sin(angles).T
    n = (ca * cb, sa * cb, -sb)
    o = (ca * sb * sg - sa * cg, sa * sb * sg + ca * cg, cb * sg)
    a = (ca * sb * cg + sa * sg, sa * sb * cg - ca * sg, cb * cg)
    return np.stack([np.stack(column, axis=1) for column in (n, o, a)], axis=2)


def turns_of(angles: np.ndarray) -> np.ndarray:
    """Return the angle of the rotation `matrices_of` each row [rad], by its quaternion: 2 atan2(|q_v|, |q_0|)."""
    (ca, cb, cg), (sa, sb, sg) = np.cos(angles / 2).T, np.sin(angles / 2).T
    scalar = ca * cb * cg + sa * sb * sg
    x = ca * cb * sg - sa * sb * cg
    y = ca * sb * cg + sa * cb * sg
    z = sa * cb * cg - ca * sb * sg
    return 2.0 * np.arctan2(np.sqrt(x * x + y * y + z * z), np.abs(scalar))


def boundary_distance(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the distance of each start from the poles, the jumps of alpha and gamma, and 180° [rad]."""
    alpha, beta, gamma = (np.abs(frame[name].to_numpy(float)) for name in ("alpha0", "beta0", "gamma0"))
    distances = {
        "pole": math.pi / 2 - beta,
        "wrap": np.minimum(math.pi - alpha, math.pi - gamma),
        "half_turn": math.pi - frame["angle0_rad"].to_numpy(float),
    }
    return pd.DataFrame(distances, frame.index)


def at_boundary(frame: pd.DataFrame, place: str, what: str) -> pd.DataFrame:
    """Return the starts that are exactly on a pole, a wrap or at 180°; NoEvidence: there is none."""
    return require_rows(frame[boundary_distance(frame)[place] <= EXACT_RAD], what)


def goal_to_pole(frame: pd.DataFrame, columns: Sequence[str] = GOAL_QUAT) -> pd.Series:
    """Return how far each goal is from the poles [rad]."""
    w, x, y, z = frame[list(columns)].to_numpy(float).T
    level = np.hypot(w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z))
    beta = np.arctan2(-2.0 * (x * z - w * y), level)
    return math.pi / 2 - pd.Series(np.abs(beta), index=frame.index)
