"""Units of an impedance example: what is felt of its stiffness and damping."""

import numpy as np
from scipy.spatial.transform import Rotation

from bench.contenders.registry import known_shipped
from bench.questions.question import Curves, Question
from tasks.rotations import about

INERTIA = np.geomspace(0.01, 1.0, 60)
SMALL = 0.01


def error(turn) -> np.ndarray:
    """The logarithm of a turn (w, x, y, z) [rad]."""
    return Rotation.from_quat(turn, scalar_first=True).as_rotvec()


def curves() -> Curves:
    """Damping ratio about an axis, by the example's error and gains, and by log and D = 2 sqrt(K I)."""
    one = known_shipped()["franka-ros"]
    K, turn = one.stiffness, about((1.0, 0.0, 0.0), SMALL)
    felt, by_log = K * one.error(turn)[0] / SMALL, K * error(turn)[0] / SMALL
    before = one.damping / (2.0 * np.sqrt(felt * INERTIA))
    return Curves(INERTIA, before, 2.0 * np.sqrt(K * INERTIA) / (2.0 * np.sqrt(by_log * INERTIA)))


QUESTION = Question(
    "franka-ros-215",
    "Units and mathematics of the example",
    ("frankarobotics/franka_ros#215",),
    "A user tries to follow the units of torque, stiffness and damping through the Cartesian impedance example, "
    "and asks for its physics.",
    "Its error is the vector part of a quaternion, without unit and half of the angle, so that K N m/rad are felt"
    " as K/2; D = 2 √K is critical damping of K for an inertia of 1 kg m², which no hand has.",
    "Twice the vector part or the logarithm for the error [rad], and D = 2 √(K I) of the inertia about the axis.",
    "inertia about the axis [kg m²]",
    "damping ratio",
    curves,
    right=1.0,
    tolerance=0.1,
    is_log_x=True,
    is_log_y=True,
)
