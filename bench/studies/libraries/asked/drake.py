"""Drake: pydrake.math, its binding of Eigen's AngleAxis, and its differential inverse kinematics.

Its inverse dynamics controller knows joints alone, and so no orientation error.
"""

from functools import partial

import numpy as np
from pydrake.common.eigen_geometry import AngleAxis, Quaternion
from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
from pydrake.multibody.inverse_kinematics import (
    DifferentialInverseKinematicsParameters,
    DoDifferentialInverseKinematics,
)
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import SpatialInertia, UnitInertia

from bench.studies.libraries.free_body import driven
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Library


def vector(found: AngleAxis) -> np.ndarray:
    """Angle times axis."""
    return found.angle() * found.axis()


def unit(quat_wxyz) -> Quaternion:
    """Normalized again: Drake refuses what is not of length 1 to 1e-14."""
    return Quaternion(quat_wxyz / np.linalg.norm(quat_wxyz))


def free() -> MultibodyPlant:
    """One body that floats."""
    plant = MultibodyPlant(0.0)
    plant.AddRigidBody("body", SpatialInertia(1.0, np.zeros(3), UnitInertia(1.0, 1.0, 1.0)))
    plant.Finalize()
    return plant


PLANT, DT_S = free(), 0.01
CONTEXT, BODY = PLANT.CreateDefaultContext(), PLANT.GetFrameByName("body")
PARAMETERS = DifferentialInverseKinematicsParameters(PLANT.num_positions(), PLANT.num_velocities())
PARAMETERS.set_time_step(DT_S)


def solved(T) -> np.ndarray:
    """The angular velocity that DoDifferentialInverseKinematics finds for a body at T^T whose goal is the identity."""
    PLANT.SetFreeBodyPose(CONTEXT, PLANT.get_body(BODY.body().index()), RigidTransform(RotationMatrix(T.T)))
    found = DoDifferentialInverseKinematics(PLANT, CONTEXT, RigidTransform(), BODY, PARAMETERS)
    return np.zeros(3) if found.joint_velocities is None else found.joint_velocities[:3]


DIFFERENTIAL = Controller(
    "DoDifferentialInverseKinematics",
    "RotationMatrix.ToAngleAxis",
    "velocity",
    "time step 10 ms, no limits",
    DT_S,
    partial(driven, solved, DT_S),
)
LIBRARY = Library(
    "drake",
    "drake",
    (
        Function("RotationMatrix.ToAngleAxis", MATRIX, lambda R: vector(RotationMatrix(R).ToAngleAxis())),
        Function("AngleAxis, of a quaternion", QUATERNION, lambda q: vector(AngleAxis(unit(q)))),
        Function(
            "2 RotationMatrix.ToQuaternion, vector part",
            MATRIX,
            lambda R: 2.0 * RotationMatrix(R).ToQuaternion().xyz(),
            "sine-of-half",
            True,
        ),
        Function("RollPitchYaw", MATRIX, lambda R: RollPitchYaw(RotationMatrix(R)).vector(), "z-y-x"),
    ),
    (DIFFERENTIAL,),
)
