"""Newton, on Warp: the errors of its controllers and of its inverse kinematics, and Warp's axis and angle."""

import newton
import numpy as np
import warp
from newton._src.controllers.impl._common import _pose_error_kernel

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


@warp.kernel
def axis_angle(given: warp.array(dtype=warp.quat), e: warp.array(dtype=warp.vec3)):  # type: ignore[valid-type]
    """warp.quat_to_axis_angle, angle times axis."""
    axis, angle = warp.vec3(), float(0.0)  # noqa: UP018 - to Warp float(0.0) is a variable, 0.0 a constant
    warp.quat_to_axis_angle(given[0], axis, angle)
    e[0] = angle * axis


@warp.kernel
def of_matrix(given: warp.array(dtype=warp.mat33), e: warp.array(dtype=warp.vec3)):  # type: ignore[valid-type]
    """warp.quat_from_matrix, then quat_to_axis_angle."""
    axis, angle = warp.vec3(), float(0.0)  # noqa: UP018 - to Warp float(0.0) is a variable, 0.0 a constant
    warp.quat_to_axis_angle(warp.quat_from_matrix(given[0]), axis, angle)
    e[0] = angle * axis


XYZW, IDENTITY = [1, 2, 3, 0], (0.0, 0.0, 0.0, 1.0)
FOUND = warp.zeros(1, dtype=warp.vec3, device="cpu")


def launched(kernel, given) -> np.ndarray:
    """A kernel on the processor."""
    warp.launch(kernel, dim=1, inputs=[given], outputs=[FOUND], device="cpu")
    return FOUND.numpy()[0]


def quat_to_axis_angle(quat_wxyz) -> np.ndarray:
    """Return axis and angle by Warp, which takes (x, y, z, w)."""
    return launched(axis_angle, warp.array([quat_wxyz[XYZW]], dtype=warp.quat, device="cpu"))


def matrix_to_axis_angle(R) -> np.ndarray:
    """Return axis and angle of a matrix by Warp."""
    return launched(of_matrix, warp.array([R], dtype=warp.mat33, device="cpu"))


def pose_error(quat_wxyz) -> np.ndarray:
    """The angular part of the pose error that its operational-space and differential-kinematics controllers take."""
    poses = [warp.array([(0.0, 0.0, 0.0, *q)], dtype=warp.transform, device="cpu") for q in (IDENTITY, quat_wxyz[XYZW])]
    found = warp.zeros(1, dtype=warp.spatial_vector, device="cpu")
    warp.launch(_pose_error_kernel, dim=1, inputs=poses, outputs=[found], device="cpu")
    return found.numpy()[0][3:]


class Residual:
    """IKObjectiveRotation of one free body whose goal is the identity: its residual at T is T's error."""

    def __init__(self) -> None:
        builder = newton.ModelBuilder()
        builder.add_body(mass=1.0)
        self.model = builder.finalize(device="cpu")
        goal = warp.array([warp.vec4(0.0, 0.0, 0.0, 1.0)], dtype=warp.vec4, device="cpu")
        self.objective = newton.ik.IKObjectiveRotation(0, warp.quat_identity(), goal)
        self.residuals = warp.zeros((1, 3), dtype=warp.float32, device="cpu")
        self.first = warp.zeros(1, dtype=warp.int32, device="cpu")
        self.objective.set_batch_layout(3, 0, 1)
        self.objective.bind_device(self.model.device)
        self.objective.init_buffers(self.model, newton.ik.IKJacobianType.ANALYTIC)

    def at(self, quat_wxyz) -> np.ndarray:
        """The residual of a body at this orientation."""
        pose = np.array([[(0.0, 0.0, 0.0, *quat_wxyz[XYZW])]], dtype=np.float32)
        bodies = warp.array(pose, dtype=warp.transform, device="cpu")
        self.objective.compute_residuals(bodies, None, self.model, self.residuals, 0, self.first)
        return self.residuals.numpy()[0]


LIBRARY = Library(
    "newton",
    "newton",
    (
        Function("controllers: _pose_error_kernel", QUATERNION, pose_error),
        Function("ik.IKObjectiveRotation, residual", QUATERNION, Residual().at),
        Function("warp.quat_to_axis_angle", QUATERNION, quat_to_axis_angle),
        Function("warp.quat_from_matrix, quat_to_axis_angle", MATRIX, matrix_to_axis_angle),
    ),
    is_single=True,
)
