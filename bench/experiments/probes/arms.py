"""Arms under the controllers of Murphy 1988: how far their angles bend, what poles do, accelerations, operations."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.experiments import traces
from bench.experiments.episodes import rows_from
from bench.experiments.experiment import Unit
from bench.experiments.kept_rows import kept
from bench.experiments.probe_values.arms import (
    BY_EULER,
    CURVES,
    INVERSES,
    OFF,
    ON_MATRIX,
    STATES,
    TASK,
)
from bench.experiments.probes.number import Number
from bench.experiments.request import Request
from bench.experiments.suites import IDEAL_MOTORS, ON_ARM
from bench.law.contenders.registry import representation
from bench.law.control.contact_controller import PAPERS_FORM
from bench.law.inputs import Gains
from bench.law.so3 import Rotation, from_quaternion

CLEAR = "clear"

BENDS = ("bend_0", "bend_1", "bend_2")

AROUND_RAD = 0.3
"""Random states are within so far of home, where J has an inverse."""

STEP_S = 1e-5
"""Differences of velocities of order 1 err by its square and by rounding over it, both under 1e-8."""

IN_CONTACT = ("hybrid-base", "hybrid/zyx-euler")


def controller(name: str, arm: str) -> str:
    """Return a controller with the inverse of an arm's joints."""
    return f"{name}+{INVERSES[tasks.arm(arm).joints]}"


def linear_response(times: np.ndarray, gains: Gains) -> np.ndarray:
    """Return x(t) of x'' = -kp x - kv x' with x(0) = 1 and x'(0) = 0, by the exponential of its matrix.

    The closed form stands in `bench.findings.theory`, which no measurement shares.
    """
    from scipy.linalg import expm

    system = np.array([[0.0, 1.0], [-gains.kp, -gains.kv]])
    return expm(system * np.asarray(times)[:, None, None])[:, 0, 0]


def euler_angles(R: Rotation) -> tuple:
    """Return alpha, beta, gamma."""
    return representation("zyx-euler").chart(R).E


def curves(
    name: str, arm: str, request: Request, dt_s: float, count: int
) -> pd.DataFrame:
    """Return traces from the first clear starts of an arm, and their departure from the linear response.

    A row a sample: start_id, time_s, position_error_m, bend_0 to bend_2 (E less E_d + (E_0 - E_d) x(t)) [rad].
    """
    unit = traces.of_arm(name, TASK, arm, count, CLEAR)
    frame = traces.rows(replace(request, dt_s=dt_s, seed=0), unit)
    goals = {
        start.id: start.goal_wxyz
        for start in tasks.start_set(CLEAR, count, 0, arm=arm)
    }
    # Once for all curves, which have the first of these times: an exponential takes up to 10 ms on a busy machine.
    response = linear_response(frame["time_s"].unique(), request.gains)
    parts = []
    for start_id, curve in frame.groupby("start_id", sort=False):
        axes = [
            curve[[f"{column}_{x}" for x in "xyz"]].to_numpy().tolist()
            for column in "noa"
        ]
        E = np.array(
            [
                euler_angles(Rotation(*columns))
                for columns in zip(*axes, strict=True)
            ]
        )
        E_d = np.array(euler_angles(from_quaternion(goals[str(start_id)])))
        part = curve[["start_id", "time_s", "position_error_m"]].copy()
        part[list(BENDS)] = E - (E_d + (E[0] - E_d) * response[: len(E), None])
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def largest(frame: pd.DataFrame) -> float:
    """Return the largest bend of any angle [rad]; infinite if one is no number."""
    bends = frame[list(BENDS)].to_numpy()
    return (
        float(np.abs(bends).max()) if np.isfinite(bends).all() else math.inf
    )


def measure_curves(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield how far the angles are from linear ones, at the run's step, at half of it, and extrapolated to step zero.

    At step zero (Richardson, of first order) also how far the position is from its goal.
    """
    name = controller(BY_EULER, unit.arm)
    words = request.contender(name).words
    full, half = (
        curves(name, unit.arm, request, dt_s, CURVES)
        for dt_s in (request.dt_s, request.dt_s / 2)
    )
    both = full.merge(
        half, on=["start_id", "time_s"], suffixes=("", "_half")
    )
    for start_id, own in both.groupby("start_id", sort=False):
        case = str(start_id)
        at_half = own[[f"{name}_half" for name in BENDS]].to_numpy()
        at_zero = np.abs(2 * at_half - own[list(BENDS)].to_numpy())
        drift = np.abs(
            2 * own["position_error_m_half"] - own["position_error_m"]
        ).to_numpy()
        whole, halved = (
            largest(rows[rows["start_id"] == start_id])
            for rows in (full, half)
        )
        yield Number("bend_rad", whole, case, words=words)
        yield Number("bend_at_half_step_rad", halved, case, words=words)
        yield Number(
            "bend_at_step_zero_rad", float(at_zero.max()), case, words=words
        )
        yield Number(
            "drift_at_step_zero_m", float(drift.max()), case, words=words
        )
        yield Number("samples", float(len(own)), case, words=words)


def episodes_at_poles(
    name: str, arm: str, request: Request
) -> pd.DataFrame:
    """Return episodes from rest at 10^-2 from a pole or nearer, to the pose of their family at 10^-1.

    The poses are those of poses.parquet (`pose_sets.pole`), and start_id is the pose's.
    """
    from bench.experiments.jacobians.pose_sets import pole
    from tasks.kinematics import kinematics

    judge = kinematics(tasks.arm(arm))
    poses = {pose.id: pose.q for pose in pole(judge, request.seed)}
    goals, starts = {}, []
    for name_of_pose, q in poses.items():
        if name_of_pose.endswith("-1e-01"):
            goals[name_of_pose.removesuffix("-1e-01")] = judge.pose(q)[1]
    for name_of_pose, q in poses.items():
        family = name_of_pose.rpartition("-1e-")[
            0
        ] or name_of_pose.removesuffix("-exact")
        if not name_of_pose.endswith("-1e-01") and family in goals:
            starts.append(judge.start(name_of_pose, q, goals[family]))
    if not starts:
        return pd.DataFrame()
    unit = Unit(
        "arm",
        name,
        TASK,
        arm,
        "native",
        "pole",
        IDEAL_MOTORS,
        count=len(starts),
        horizon_s=ON_ARM,
    )
    return rows_from(request, unit, starts)


def measure_poles(request: Request, unit: Unit) -> Iterator[Number]:
    """Yield the peak torque of episodes that start beside poles, by both controllers."""
    for one in (BY_EULER, ON_MATRIX):
        name = controller(one, unit.arm)
        words = request.contender(name).words
        for row in episodes_at_poles(name, unit.arm, request).to_dict(
            "records"
        ):
            case, outcome = row["start_id"], row["outcome"]
            yield Number(
                "peak_tau_nm",
                row["peak_tau_nm"],
                case,
                outcome=outcome,
                words=words,
            )


def measure_accelerations(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield |xddot - u| / |u| under (2.2) at random states; at: masses of the plant over those of the model."""
    for factor, variation in (
        (1.0, ""),
        (float(OFF.partition("-")[2]), OFF),
    ):
        for k, gap in enumerate(
            accelerations(unit.arm, variation, request.seed)
        ):
            yield Number("acceleration_gap", gap, f"state-{k:02d}", factor)


def accelerations(name: str, variation: str, seed: int) -> list[float]:
    """Compute |xddot - u| / |u| of an arm under (2.2) at random states; a variation makes the plant another one."""
    import mujoco

    from tasks.arm_model import model_xml
    from tasks.kinematics import Kinematics

    arm = tasks.arm(name)
    judge = Kinematics(arm)
    plant = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    if variation:
        tasks.variation(variation).apply(plant, arm.rated)
    data, body = mujoco.MjData(judge.model), mujoco.MjData(plant)
    rng, found = np.random.default_rng(seed), []
    for _ in range(STATES):
        q = np.array(arm.home) + rng.uniform(
            -AROUND_RAD, AROUND_RAD, judge.model.nv
        )
        qdot = rng.uniform(-1.0, 1.0, judge.model.nv)
        u = rng.uniform(-1.0, 1.0, 6)
        data.qpos[:], data.qvel[:] = q, qdot
        mujoco.mj_forward(judge.model, data)
        bias = data.qfrc_bias - data.qfrc_passive
        body.qpos[:], body.qvel[:] = q, qdot
        body.qfrc_applied[:] = (
            judge.inertia_matrix(q) @ resolved(judge, q, qdot, u) + bias
        )
        mujoco.mj_forward(plant, body)
        xddot = hand_acceleration(judge, q, qdot, body.qacc)
        found.append(float(np.linalg.norm(xddot - u) / np.linalg.norm(u)))
    return found


def resolved(
    judge: Any, q: np.ndarray, qdot: np.ndarray, u: np.ndarray
) -> np.ndarray:
    """Compute J^-1 (u - Jdot qdot), with Jdot by differences along the motion."""
    J = judge.jacobian(q)
    ends = [judge.jacobian(q + t * qdot) for t in (STEP_S, -STEP_S)]
    Jdot = (ends[0] - ends[1]) / (2 * STEP_S)
    return np.linalg.solve(J, u - Jdot @ qdot)


def hand_acceleration(
    judge: Any, q: np.ndarray, qdot: np.ndarray, qacc: np.ndarray
) -> np.ndarray:
    """Compute d(J qdot)/dt by differences along the motion that follows, to second order in t."""
    ends = []
    for t in (-STEP_S, STEP_S):
        ends.append(
            judge.jacobian(q + t * qdot + t * t / 2 * qacc)
            @ (qdot + t * qacc)
        )
    return (ends[1] - ends[0]) / (2 * STEP_S)


def measure_contact_costs(
    request: Request, unit: Unit
) -> Iterator[Number]:
    """Yield flops and calls of a typical control period in contact; at: the number of joints."""
    for name in IN_CONTACT:
        for joints in INVERSES:
            whole = f"{name}+{PAPERS_FORM}"
            make = functools.partial(count_rows, whole, joints)
            [counted] = kept(f"contact-costs/{whole}-{joints}", make)
            for measure, value in counted.items():
                yield Number(measure, float(value), whole, joints)


def count_rows(name: str, joints: int) -> list[dict]:
    """Return one row: flops and calls of a controller's typical control period on an arm of so many joints."""
    from bench.engines.counting import TOTAL, flops
    from bench.engines.counting.in_contact import cost_in_contact
    from bench.law.control.registry import find_controller

    numbers = cost_in_contact(
        find_controller(name), joints=joints
    ).typical.of(TOTAL)
    calls = sum(numbers[call] for call in ("sin", "cos", "atan2", "acos"))
    return [{"flops": int(flops(numbers)), "calls": int(calls)}]
