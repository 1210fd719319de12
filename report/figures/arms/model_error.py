"""The page on model errors: how far from the goal the tool ends when the plant is not the model, and what theory says.

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
from report.figures.arms import arm_looks, arm_rows
from report.figures.kit.page import ABSENT, NotInRun, Run
from tasks.arm_model import model_xml
from tasks.kinematics import kinematics, rotation_vector
from tasks.paths import geodesic

SHOWN = (arm_rows.ON_MATRIX, arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)
UNIFORM = "mass-"
STEPS = 60
"""Points of a geodesic along which the arm's posture at the goal is followed."""


@functools.cache
def compared(run: Run) -> pd.DataFrame:
    """Rows by the controllers that settle every clear start of a perfect model, so that what is left is the model's."""
    varied = arm_rows.varied(run)
    if varied.empty:
        raise NotInRun("no variation")
    return arm_rows.with_standard(varied[varied["controller"].isin(SHOWN)])


def facts(run: Run) -> dict:
    """Whole sentences: what variations leave, on what that stands, and what of it is gravity's."""
    own = compared(run)
    medians = np.degrees(own.groupby("variation")["final_angle_rad"].median())
    angles = own.pivot_table(
        index=["arm", "start_id", "variation"], columns="controller", values="final_angle_rad", observed=True
    ).dropna()
    apart = np.degrees((angles.max(axis=1) - angles.min(axis=1)).median())
    nominal = arm_rows.episodes(run)
    clear = nominal[(nominal["start_set"] == "clear") & nominal["controller"].isin(SHOWN)]
    lost = int((~arm_rows.settled(arm_rows.with_standard(clear))).sum())
    settled = 100.0 * float(arm_rows.settled(own).mean())
    return {
        "lead": f"From the same start the controllers end {apart:.1g}° apart in the median; the worst variation, "
        f"{medians.idxmax()}, leaves {medians.max():.1f}°, the mildest, {medians.idxmin()}, {medians.min():.2f}°.",
        "setting": f"From clear starts, {len(own)} episodes of {float(own['horizon_s'].max()):g} s by "
        f"{own['controller'].nunique()} controllers on {len(arm_looks.arms(own))} arms. With a perfect model {lost} of "
        f"their clear episodes fail; with these {settled:.0f} % settle, and the others stay outside "
        f"{100 * float(own['tolerance'].iloc[0]):g} % of the initial angle.",
        "gravity": by_gravity(own),
    }


def by_gravity(own: pd.DataFrame) -> str:
    """Measured angle over that of the formula, for arms of six joints and of seven."""
    found = predicted(own)
    joints = found["arm"].map(lambda name: tasks.arm(name).joints)
    said = []
    for words, rows in (("six joints", found[joints == 6]), ("seven", found[joints > 6])):
        ratio = ratios(rows)
        if len(ratio):
            low, middle, high = ratio.quantile(0.05), ratio.median(), ratio.quantile(0.95)
            said.append(f"on {words} {middle:.3f} in the median ({low:.2f} to {high:.2f} from 5 to 95 %)")
    return f"Measured over predicted is {', '.join(said)}." if said else f"The comparison is {ABSENT}."


def predicted(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows whose masses are all wrong by one factor, with the angle that gravity alone leaves [rad], NaN if unknown.

    Args:
        rows: of `compared`.
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
