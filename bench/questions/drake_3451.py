"""The axis of a rotation by 180 degrees is zero."""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.questions.question import Curves, Question

AXIS = np.array([0.0, 0.0, 1.0])
SHORT_DEG = np.concatenate((np.geomspace(10.0, 1e-8, 60), [0.0]))


def by_differences(R: np.ndarray) -> np.ndarray:
    """theta k with k along R - R^T, whose elements all vanish at 180 degrees; no axis where it is zero."""
    v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    length = np.linalg.norm(v)
    theta = np.arccos(np.clip(0.5 * (np.trace(R) - 1.0), -1.0, 1.0))
    return theta * v / length if length > 0.0 else np.zeros(3)


def off(R: np.ndarray, rotvec: np.ndarray) -> float:
    """Angle between R and the rotation that a vector says [deg]."""
    return float(np.degrees((Rotation.from_rotvec(rotvec).inv() * Rotation.from_matrix(R)).magnitude()))


def curves() -> Curves:
    """Angle between R and what is rebuilt of its axis and angle [deg]."""
    turns = [Rotation.from_rotvec(np.radians(180.0 - short) * AXIS).as_matrix() for short in SHORT_DEG]
    turns[-1] = np.diag([-1.0, -1.0, 1.0])
    before = [off(R, by_differences(R)) for R in turns]
    return Curves(SHORT_DEG, np.array(before), np.array([off(R, Rotation.from_matrix(R).as_rotvec()) for R in turns]))


QUESTION = Question(
    "drake-3451",
    "The axis is zero at 180°",
    ("RobotLocomotion/drake#3451", "RobotLocomotion/drake#601"),
    "The conversion of a half turn about z returns 180° about the zero vector. A commenter suspects it behind the fall "
    "of a humanoid in a competition.",
    "The axis is taken from R − Rᵀ, which vanishes at 180°; before it does, its digits are lost.",
    "Convert R to a quaternion by its largest element, which never divides by what is small, and take the axis of"
    " that.",
    "degrees short of 180°",
    "angle between R and what its axis and angle rebuild [deg]",
    curves,
    tolerance=1e-5,
)
