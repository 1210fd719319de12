"""Small experiments that claims make themselves: a law at one state, a few episodes, curves and poses of arms."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

import tasks
from bench.base.on_first_use import Turn, pd
from bench.experiments import traces
from bench.experiments.episodes import rows_from
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.suites import IDEAL_MOTORS, ON_ARM
from bench.findings.claims.tables import some
from bench.findings.theory.closed_form import linear, linear_settling
from bench.findings.theory.compliance_theory import matrix_B
from bench.law.contenders.registry import find_contender, representation
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import IDENTITY, Rotation, from_quaternion
from tasks.base import Start
from tasks.haar import axes

PAPER = Gains()
QUAT = ("quat_w", "quat_x", "quat_y", "quat_z")
GOAL_QUAT = tuple(f"goal_{name}" for name in QUAT)
OMEGA = ("omega0_x", "omega0_y", "omega0_z")

EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad from a pole or from 180°) and what rounding leaves of an exact
one (4e-16 rad)."""


def doubles(numbers: Iterable) -> Any:
    """Nested tuples with numpy's doubles, for which 1/0 is infinite as in every engine."""
    inside = [doubles(x) if isinstance(x, tuple) else np.float64(x) for x in numbers]
    return type(numbers)(*inside) if hasattr(numbers, "_fields") else tuple(inside)


def command(contender: str, R: Rotation, omega: Any = AT_REST, R_d: Rotation = IDENTITY, gains: Gains = PAPER) -> Any:
    """u of a law at one state."""
    goal = doubles(Goal(R_d))
    with np.errstate(all="ignore"):
        return np.array(find_contender(contender).law(doubles(R), doubles(omega), goal, doubles(gains)))


def euler_B(R: Rotation) -> np.ndarray:
    """B of Z-Y-X angles."""
    return matrix_B(representation("zyx-euler"), R)


HALF = math.sqrt(0.5)
ABOUT_Y = {180: (0.0, 0.0, 1.0, 0.0), 90: (HALF, 0.0, HALF, 0.0), -90: (HALF, 0.0, -HALF, 0.0)}
"""Quaternions of rotations about Y by so many degrees: the last two are the poles of Z-Y-X angles."""


def least_of_B(quat: tuple) -> float:
    """Return the smallest singular value of B at an orientation."""
    return float(np.linalg.svd(euler_B(from_quaternion(quat)), compute_uv=False)[-1])


def euler_angles(R: Rotation) -> tuple:
    """alpha, beta, gamma."""
    return representation("zyx-euler").chart(R).E


def euler_angles_along(trace: pd.DataFrame) -> np.ndarray:
    """alpha, beta, gamma of each sample of a trace, n x 3."""
    n, o, a = (trace[[f"{c}_{x}" for x in "xyz"]].to_numpy().tolist() for c in "noa")
    return np.array([euler_angles(Rotation(*triple)) for triple in zip(n, o, a, strict=True)])


def rotations(frame: pd.DataFrame, columns: Sequence[str] = QUAT) -> list[Rotation]:
    """Return the orientation of each row."""
    return [from_quaternion(tuple(quat)) for quat in frame[list(columns)].to_numpy().tolist()]


def about(axis: Sequence[float] | np.ndarray, angle: float) -> tuple:
    """Return the quaternion of a rotation."""
    unit = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    return (math.cos(angle / 2), *(math.sin(angle / 2) * unit).tolist())


def episodes(contender: str, starts: list[Start], gains: Gains, dt_s: float, horizon_s: float) -> pd.DataFrame:
    """Rows of episodes.parquet of a few starts on the continuous plant."""
    unit = Unit("free-body", contender, "free-body", engine="ideal-rk4", count=len(starts), horizon_s=horizon_s)
    return rows_from(Settings(gains=gains, dt_s=dt_s), unit, starts)


def off_linear(contender: str, angle: float, about_axes: Any, gains: Gains, dt_s: float) -> np.ndarray:
    """Return how far rotations about axes settle from the linear closed form, relatively; infinite: one does not."""
    starts = [Start("", about(axis, angle)) for axis in about_axes]
    times = episodes(contender, starts, gains, dt_s, 20.0)["settling_time_s"].to_numpy()
    return np.nan_to_num(np.abs(times / linear_settling(*gains) - 1), nan=np.inf)


SPEED, BESIDE = 20.0, 64
"""rad/s, as fast as the fastest tumbling start; starts at each margin."""


@functools.cache
def beside_pole(margin: float, contender: str, gains: Gains, dt_s: float = 1e-3) -> pd.DataFrame:
    """Bodies that spin at 20 rad/s, in directions all over the sphere, a thousandth of a radian outside a margin."""
    zyx = representation("zyx-euler")
    starts = []
    for i, direction in enumerate(axes(BESIDE)):
        alpha, gamma = (math.remainder(turn * (i + 0.5), 2 * math.pi) / 2 for turn in (2.4, 3.7))
        R = zyx.to_matrix((alpha, (-1) ** i * (math.pi / 2 - margin - 1e-3), gamma))
        quat = Turn.from_matrix(np.array(R).T).as_quat(scalar_first=True)
        starts.append(Start("", tuple(quat.tolist()), tuple((SPEED * direction).tolist())))
    return episodes(contender, starts, gains, dt_s, 10.0)


@functools.cache
def perturbed(law: str, axis: str, starts: int, horizon_s: float, gains: Gains, seed: int) -> pd.DataFrame:
    """Rows of robustness.parquet of a law along a perturbation."""
    unit = Unit("robustness", law, selector=axis, count=starts, total=starts, horizon_s=horizon_s)
    return rows_of(Settings(gains=gains, seed=seed), unit)


def boundary_distance(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the distance of each start from the poles, the jumps of alpha and gamma, and 180° [rad]."""
    return pd.DataFrame(
        {
            "pole": math.pi / 2 - frame["beta0"].abs(),
            "wrap": np.minimum(math.pi - frame["alpha0"].abs(), math.pi - frame["gamma0"].abs()),
            "half_turn": math.pi - frame["angle0_rad"],
        }
    )


def at_boundary(frame: pd.DataFrame, place: str, what: str) -> pd.DataFrame:
    """Return the starts that are exactly on a pole, a wrap or at 180°; NoEvidence: there is none."""
    return some(frame[boundary_distance(frame)[place] <= EXACT_RAD], what)


def goal_to_pole(frame: pd.DataFrame) -> pd.Series:
    """How far each goal is from the poles [rad]."""
    betas = [abs(euler_angles(R)[1]) for R in rotations(frame, GOAL_QUAT)]
    return math.pi / 2 - pd.Series(betas, index=frame.index)


TASK = "arm-regulation"
BENDS = ("bend_0", "bend_1", "bend_2")


def curves(word: str, arm: str, gains: Gains, dt_s: float, count: int) -> pd.DataFrame:
    """Return traces of a contender from the first clear starts of an arm, and their departure from the closed form.

    A row a sample: start_id, time_s, position_error_m, bend_0 to bend_2 (E less E_d + (E_0 - E_d) linear(t)) [rad].
    """
    unit = traces.of_arm(word, TASK, arm, count, "clear")
    frame = traces.rows(Settings(gains=gains, dt_s=dt_s), unit)
    goals = {start.id: start.goal_wxyz for start in tasks.start_set("clear", count, 0, arm=arm)}
    parts = []
    for id, curve in frame.groupby("start_id", sort=False):
        E = euler_angles_along(curve)
        E_d = np.array(euler_angles(from_quaternion(goals[str(id)])))
        expected = E_d + (E[0] - E_d) * linear(curve["time_s"], *gains)[:, None]
        part = curve[["start_id", "time_s", "position_error_m"]].copy()
        part[list(BENDS)] = E - expected
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def beside_poles(word: str, arm: str, poses: pd.DataFrame, gains: Gains) -> pd.DataFrame:
    """Return episodes from rest at poses of a table, at 10^-2 from a pole or nearer, to that of their family at 10^-1.

    start_id is the pose's. NoEvidence: the table has no such pose of the arm, or none of its family at 10^-1.
    """
    from tasks.kinematics import kinematics

    judge = kinematics(tasks.arm(arm))
    own = poses[(poses["arm"] == arm) & (poses["pose_set"] == "pole")].drop_duplicates("pose_id")
    names = [f"q_{i + 1}" for i in range(tasks.arm(arm).joints)]
    at = {str(id): tuple(q) for id, q in zip(own["pose_id"], own[names].to_numpy().tolist(), strict=True)}
    goals = {id.removesuffix("-1e-01"): judge.pose(q)[1] for id, q in at.items() if id.endswith("-1e-01")}
    starts = [
        judge.start(id, q, goals[family])
        for id, q in at.items()
        if not id.endswith("-1e-01") and (family := id.rpartition("-1e-")[0] or id.removesuffix("-exact")) in goals
    ]
    some(starts, f"pose of {arm} beside a pole")
    unit = Unit("arm", word, TASK, arm, "native", "pole", IDEAL_MOTORS, count=len(starts), horizon_s=ON_ARM)
    return rows_from(Settings(gains=gains), unit, starts)


def largest(frame: pd.DataFrame) -> float:
    """Return the largest bend of any angle [rad]; infinite if one is no number."""
    bends = frame[list(BENDS)].to_numpy()
    return float(np.abs(bends).max()) if np.isfinite(bends).all() else math.inf
