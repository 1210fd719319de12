"""Predict where an arm with a wrong model comes to rest, and compare it with the measurement.

With masses and inertias wrong by a factor s it rests where the command makes up for the gravity that the model has
not: s fg = D x + fg, so that a = J x and

    Kp e = (s - 1) J D^-1 fg          D and fg those of the model, at the goal

and with dry friction wherever friction can hold what the command asks for, |D J^-1 Kp e| <= f: an error is held as
long as the friction is large beside the inertia.

Limitations: on seven joints the posture at rest is not known, for nothing drives it; the formula takes the nearest one.
"""

from __future__ import annotations

import functools
import math

import mujoco
import numpy as np
import pandas as pd

import tasks
from tasks.arm_model import model_xml
from tasks.kinematics import kinematics, rotation_vector
from tasks.paths import geodesic

UNIFORM = "mass-"
STEPS = 60
"""Points of a geodesic along which the arm's posture at the goal is followed."""


def predicted(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows whose masses are all wrong by one factor, with the angle that gravity alone leaves [rad], NaN if unknown.

    Args:
        rows: of `model_error.compared`.
    """
    scaled = rows[rows["variation"].str.startswith(UNIFORM)]
    angles = [_gravity_angle(row) for _, row in scaled.iterrows()]
    return scaled.assign(gravity_rad=angles)


def _gravity_angle(row: pd.Series) -> float:
    start = next((one for one in _starts(str(row["arm"])) if one.id == row["start_id"]), None)
    if start is None:
        return math.nan
    factor = float(str(row["variation"]).removeprefix(UNIFORM))
    return abs(factor - 1.0) * _pull(str(row["arm"]), start) / float(row["kp"])


@functools.cache
def _starts(arm: str) -> tuple:
    return tuple(tasks.start_set("clear", arm=arm))


@functools.cache
def _pull(arm: str, start) -> float:
    """|J D^-1 fg|, its rows of orientation, with the tool at the goal [rad/s^2]; NaN if the arm cannot be led there."""
    one = tasks.arm(arm)
    turn = np.array(rotation_vector(start.goal_wxyz, start.quat_wxyz))
    angle = float(np.linalg.norm(turn))
    axis = (turn / angle).tolist()
    path = kinematics(one).follow(start.q, geodesic(start.quat_wxyz, tuple(axis), angle, STEPS))
    if path is None:
        return math.nan
    D, fg = _dynamics(arm, tuple(path[-1]))
    return float(np.linalg.norm((kinematics(one).jacobian(path[-1]) @ np.linalg.solve(D, fg))[3:]))


def _dynamics(arm: str, q: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """D and fg at rest, by MuJoCo."""
    model = mujoco.MjModel.from_xml_string(model_xml(tasks.arm(arm), 1e-3))
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    D = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, D)
    return D, data.qfrc_bias - data.qfrc_passive


def ratios(found: pd.DataFrame) -> pd.Series:
    """Measured over predicted, of episodes that did not fail outright."""
    ended = found[~found["outcome"].isin(("saturated", "diverged", "singular", "crashed", "hung"))]
    return (ended["final_angle_rad"] / ended["gravity_rad"]).dropna()
