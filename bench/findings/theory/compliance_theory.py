"""What theory predicts of a hand in free space that complies with small moments: C, the rotation per moment, 3 x 3.

    hybrid, accelerations   C = B_C B_C^T  free(t)       B_C: the columns of B whose coordinates comply
    hybrid, transpose       C = B R(t) B^-1 A (I + kf B^-T (I - S) B^T)
    impedance-coordinates   C = B B^T      sprung(t)
    other impedances        C = I          sprung(t)

from Edot = B^-1 omega (Murphy 1988, 3.2) and F_E = B^T m (3.12): coordinates that comply turn the hand along columns of
B, and are turned by what B^T takes of a moment. On axes of the base or the hand B = I. All is to first order in the
moment, and B is that of the goal.

By the Jacobian transpose nothing is cancelled: the moment acts through A, the rotational block of J D^-1 J^T, and what
J^T adds to it is kf B^-T (I - S) B^T m; then each coordinate answers for itself, R(t) = diag of free(t) where it
complies, sprung(t) where it is held, of inertia 1. A moment that is not converted has its components for B^T m.

With Z-Y-X angles B B^T has the eigenvalues 1 and 1 -+ sin beta, at any alpha and gamma: a hand that complies about x
and y leaks tan |beta| about z, and at the poles a moment is lost.

Limitations: no prediction (NaN) for moments that are not converted and yet cancelled, since what is not cancelled then
acts on the whole arm; nor where B^-1 does not exist; nor for the forms of SELECTION_ORDERS. Radians, N m.
Source: Murphy 1988, 3.1 and 3.3; Hogan 1985 for stiffness in other coordinates, K -> B^-T K B^-1.
"""

import functools
import math

import numpy as np

from bench.findings.theory.closed_form import linear
from bench.law.control.contact_controller import PAPERS_FORM, SELECTION_ORDERS, ContactController
from bench.law.control.hybrid import conversion
from bench.law.control.setpoint import TOUCH, ContactParameters
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.law.kinds import Coordinates
from bench.law.so3 import IDENTITY, Rotation
from tasks.arm_model import Arm
from tasks.contact import Specification

NOWHERE = 1e-12
"""Smallest singular value of B, over its largest, at which there is no B^-1: rounding of an angle of pi/2."""


def matrix_B(representation: Coordinates, R: Rotation) -> np.ndarray:
    """Compute B of omega = B Edot (Murphy 1988, 2.8): what each coordinate turns the hand about, in its columns."""
    at = representation.chart(R)
    return np.array([representation.angular_velocity(at, tuple(rate)) for rate in np.eye(len(at.E)).tolist()]).T


def compliance(
    controller: ContactController,
    specification: Specification,
    goal: Rotation,
    time_s: float,
    gains: Gains = PAPERS_GAINS,
    touch: ContactParameters = TOUCH,
    arm: Arm | None = None,
) -> np.ndarray:
    """Return C [rad/(N m)], 3 x 3: what a controller makes of a constant moment in some time, from rest at its goal.

    An impedance ignores the specification. The arm is needed where the moment acts through its inertia, by the Jacobian
    transpose.
    """
    if controller.form in SELECTION_ORDERS:
        return np.full((3, 3), np.nan)
    B = directions(controller, goal)
    if controller.form != PAPERS_FORM:
        if not controller.converts:
            return np.full((3, 3), np.nan)
        if controller.impedance is not None:
            return B @ B.T * sprung(time_s, gains, touch.m_o)
        own = B[:, np.array(controller.selection(specification)[3:]) == 0.0]
        return own @ own.T * free(time_s, touch)
    if arm is None:
        raise TypeError(f"'{controller.name}' lets moments act through the inertia of an arm (try: arm=)")
    if not np.isfinite(B).all():
        return B
    K = np.eye(3)  # what the controller takes of a moment
    if controller.representation is not None:
        convert, at = conversion(controller.representation, controller.converts), controller.representation.chart(goal)
        K = np.array([convert(at, unit) for unit in np.eye(3).tolist()]).T
    held, as_unit = np.array(controller.selection(specification)[3:]), touch._replace(m_o=1.0)
    kept = (
        free(time_s, as_unit._replace(kc=gains.kv)) if controller.law == "hybrid-rate" else sprung(time_s, gains, 1.0)
    )
    answers = np.where(held > 0.0, kept, free(time_s, as_unit))
    exerted = np.linalg.solve(B.T, (1.0 - held)[:, None] * K)
    return B @ (answers[:, None] * np.linalg.solve(B, mobility(arm) @ (np.eye(3) + touch.kf * exerted)))


def directions(controller: ContactController, goal: Rotation) -> np.ndarray:
    """Return the axes of a controller's rotational rows, 3 x 3, base frame; NaN if there is no B^-1."""
    if controller.representation is None:
        return np.eye(3)
    seen_from_goal = controller.impedance is not None and controller.impedance.relative
    B = matrix_B(controller.representation, IDENTITY if seen_from_goal else goal)
    size = np.linalg.svd(B, compute_uv=False)
    if size[-1] <= NOWHERE * size[0]:
        return np.full((3, 3), np.nan)
    return np.array(goal).T @ B if seen_from_goal else B


@functools.cache
def mobility(arm: Arm) -> np.ndarray:
    """Return J D^-1 J^T of rotations in the tasks' posture: angular acceleration per moment [1/(kg m^2)]."""
    from tasks.kinematics import kinematics  # MuJoCo takes a moment to import; naming claims needs it not

    return kinematics(arm).mobility(arm.home)[3:, 3:]


def free(time_s: float, touch: ContactParameters = TOUCH) -> float:
    """Rotation per moment [rad/(N m)] of what complies: m_o thetadd = m - m_o kc thetad from rest."""
    return (time_s - (1.0 - math.exp(-touch.kc * time_s)) / touch.kc) / (touch.kc * touch.m_o)


def sprung(time_s: float, gains: Gains = PAPERS_GAINS, inertia: float = TOUCH.m_o) -> float:
    """Rotation per moment [rad/(N m)] of an impedance: m_o (thetadd + kv thetad + kp theta) = m from rest."""
    return (1.0 - float(linear(time_s, *gains))) / (gains.kp * inertia)
