"""Questions that users of robot libraries asked in public (questions.toml), and a number without and with the cure.

Each measurement restates a public thread in a few lines: nobody's code runs here.
"""

import itertools
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from bench.experiments.limiters import GREATEST_RATE, clamp_axes, clamp_norm
from bench.law.contenders.registry import contenders
from tasks.goal_stream import STREAMS, componentwise, continued, goals, normalized, slerp
from tasks.rotations import about
from tasks.truth import angle


class FieldQuestion(NamedTuple):
    """A public thread; its first one names it.

    threads: owner/repository#number. quantity: what measure() returns, without and with the cure; it is right where it
    differs from `right` by at most `tolerance`.
    """

    title: str
    threads: tuple[str, ...]
    cause: str
    cure: str
    quantity: str
    measure: Callable[[], tuple[float, ...]]
    right: float = 0.0
    tolerance: float = 1e-6


def angle_between(a: Any, b: Any) -> float:
    """Return the angle between two vectors [deg]."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b))))


def measure_vector_part() -> tuple[float, ...]:
    """Compare the vector part of a quaternion, w < 0, with the rotation vector, over the angle."""
    half = np.radians(45.0)
    w, v = -np.cos(half), -np.sin(half)
    return v / (2.0 * half), 2.0 * np.arctan2(-v, -w) / (2.0 * half)


def measure_angle_difference() -> tuple[float, ...]:
    """Compare a small difference of Z-Y-X angles, and B times it, with the rotation vector to the goal."""
    (a, b, c), difference = (0.4, np.radians(60.0), 0.3), 1e-4 * np.array([1.0, 0.0, 1.0])
    R, R_d = (Rotation.from_euler("ZYX", angles) for angles in ((a, b, c), np.add((a, b, c), difference)))
    B = [[0.0, -np.sin(a), np.cos(a) * np.cos(b)], [0.0, np.cos(a), np.sin(a) * np.cos(b)], [1.0, 0.0, -np.sin(b)]]
    needed = (R_d * R.inv()).as_rotvec()
    return angle_between(difference, needed), angle_between(B @ difference, needed)


def measure_axis_of_180_degrees() -> tuple[float, ...]:
    """Rebuild a rotation by 180 degrees from its axis by R - R^T, and from its quaternion."""
    R = np.diag([-1.0, -1.0, 1.0])
    by_differences = np.pi * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    rebuilt = (Rotation.from_rotvec(one) for one in (by_differences, Rotation.from_matrix(R).as_rotvec()))
    return tuple(float(np.degrees((one.inv() * Rotation.from_matrix(R)).magnitude())) for one in rebuilt)


def measure_damping_ratio() -> tuple[float, ...]:
    """Compute the damping ratio of the franka_ros example about an axis, and with the logarithm and D = 2 sqrt(K I)."""
    example, inertia, small = contenders("shipped")["franka-ros"], 0.1, 0.01
    K, turn = example.gains.kp, about((1.0, 0.0, 0.0), small)
    by_example, by_log = example.error(turn)[0], Rotation.from_quat(turn, scalar_first=True).as_rotvec()[0]
    D, felt = (example.gains.kv, 2.0 * np.sqrt(K * inertia)), (K * by_example / small, K * by_log / small)
    return D[0] / (2.0 * np.sqrt(felt[0] * inertia)), D[1] / (2.0 * np.sqrt(felt[1] * inertia))


def measure_quaternion_order() -> tuple[float, ...]:
    """Read the identity, (w, x, y, z), in the other order and in its own."""
    read = (Rotation.from_quat([1.0, 0.0, 0.0, 0.0], scalar_first=first) for first in (False, True))
    return tuple(float(np.degrees(one.magnitude())) for one in read)


def measure_arc_cosine() -> tuple[float, ...]:
    """Compute the relative error of an angle of 1e-9 rad by arc cosine and by atan2."""
    theta = 1e-9
    R = Rotation.from_rotvec(theta * np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0)).as_matrix()
    c, v = 0.5 * (np.trace(R) - 1.0), 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    before, after = np.arccos(np.clip(c, -1.0, 1.0)), np.arctan2(np.linalg.norm(v), c)
    return abs(before / theta - 1.0), abs(after / theta - 1.0)


def measure_overshoot() -> tuple[float, ...]:
    """Compute the overshoot of a step from the damping ratio that D = 2 sqrt(K), and D = 2 sqrt(K I), make."""
    K, inertia = 250.0, 10.0
    ratios = (D / (2.0 * np.sqrt(K * inertia)) for D in (2.0 * np.sqrt(K), 2.0 * np.sqrt(K * inertia)))
    return tuple(100.0 * np.exp(-np.pi * z / np.sqrt(1.0 - z * z)) if z < 1.0 else 0.0 for z in ratios)


def measure_goal_rate() -> tuple[float, ...]:
    """Find the highest rate of a goal stream that is filled in by component and by the logarithm."""
    dt, by_name = 1e-3, {stream.name: stream for stream in STREAMS}
    filled = (goals(by_name[name], dt).tolist() for name in ("rotation-vector", "log"))
    return tuple(max(angle(a, b) for a, b in itertools.pairwise(stream)) / dt for stream in filled)


def measure_scaled_action() -> tuple[float, ...]:
    """Run 20 steps of a loop whose action is scaled by the lower bound and by the upper bound."""
    before = after = 0.5
    for _ in range(20):
        before += 0.1 * np.clip(before, -1.0, 1.0)
        after -= 0.1 * np.clip(after, -1.0, 1.0)
    return before / 0.5, after / 0.5


def measure_tolerance_box() -> tuple[float, ...]:
    """Compare the first two numbers of a rotation vector, and of X-Y-Z angles, with the tilt that they bound."""
    tilt = np.radians(3.0)
    R = Rotation.from_rotvec([tilt, 0.0, 0.0]) * Rotation.from_rotvec([0.0, 0.0, np.radians(170.0)])
    return float(np.linalg.norm(R.as_rotvec()[:2]) / tilt), float(np.linalg.norm(R.as_euler("XYZ")[:2]) / tilt)


def measure_clipped_direction() -> tuple[float, ...]:
    """Compare a command of three times the limit with what a clip by component, and one of the norm, leave of it."""
    omega = 3.0 * GREATEST_RATE * np.array([np.cos(np.radians(20.0)), np.sin(np.radians(20.0)), 0.0])
    return tuple(angle_between(omega, limit(tuple(omega.tolist()), 1.0)) for limit in (clamp_axes, clamp_norm))


def measure_stiffness_frame() -> tuple[float, ...]:
    """Compare the torque of a diagonal stiffness, as it is and rotated, with that of the spring in the tool's axes."""
    R, K = Rotation.from_rotvec([0.0, np.radians(60.0), 0.0]).as_matrix(), np.diag([100.0, 10.0, 10.0])
    error = np.array([0.0, 1.0, 1.0])
    meant = R @ K @ error
    return angle_between(K @ R @ error, meant), angle_between(R @ K @ R.T @ R @ error, meant)


def measure_masked_axis() -> tuple[float, ...]:
    """Compare a logarithm without its z component, and z x z_d, with the shortest rotation of the tool's axis."""
    wanted = Rotation.from_rotvec([np.radians(5.0), 0.0, 0.0]) * Rotation.from_rotvec([0.0, 0.0, np.radians(120.0)])
    z, z_d = np.array([0.0, 0.0, 1.0]), wanted.as_matrix()[:, 2]
    needed = Rotation.align_vectors([z_d], [z])[0].as_rotvec()
    return angle_between(wanted.as_rotvec() * [1.0, 1.0, 0.0], needed), angle_between(np.cross(z, z_d), needed)


def measure_interpolation() -> tuple[float, ...]:
    """Interpolate half of 60 degrees between quaternions of opposite signs by component, and by slerp."""
    axis, turn, half = (0.0, 1.0, 0.0), np.radians(60.0), np.array([[0.5]])
    q = np.array([about(axis, 0.0), [-one for one in about(axis, turn)]])
    middles = normalized(componentwise(q, half)), slerp(continued(q), half)
    return tuple(float(np.degrees(angle(one[0].tolist(), about(axis, 0.5 * turn)))) for one in middles)


QUESTIONS = tuple(
    FieldQuestion(
        measure=globals()[f"measure_{word}"], **{**texts, "threads": tuple(texts["threads"])}
    )
    for word, texts in tomllib.loads(
        Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    ).items()
)
"""In the order of the file."""
