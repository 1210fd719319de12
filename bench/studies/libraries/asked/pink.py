"""Pink: the error of its FrameTask, on Pinocchio's logarithm of a pose, and its solve_ik."""

from collections.abc import Iterator

import numpy as np
import pink
import pinocchio

from bench.studies.libraries.free_body import conjugate
from bench.studies.libraries.library import MATRIX, Controller, Function, Library


def free_flyer() -> pink.Configuration:
    """A body that floats, at the identity."""
    model = pinocchio.Model()
    model.addJoint(0, pinocchio.JointModelFreeFlyer(), pinocchio.SE3.Identity(), "root")
    model.addFrame(pinocchio.Frame("body", 1, 0, pinocchio.SE3.Identity(), pinocchio.FrameType.BODY))
    return pink.Configuration(model, model.createData(), pinocchio.neutral(model))


BODY = free_flyer()
DT_S = 0.005


def frame_task(R) -> np.ndarray:
    """FrameTask.compute_error of a body at the identity whose target is turned; its angular part."""
    task = pink.FrameTask("body", position_cost=1.0, orientation_cost=1.0)
    task.set_target(pinocchio.SE3(R, np.zeros(3)))
    return task.compute_error(BODY)[3:]


def solved(quat_wxyz) -> Iterator[tuple]:
    """solve_ik and integrate_inplace tick by tick, as in Pink's examples, towards the identity."""
    w, x, y, z = conjugate(quat_wxyz)
    configuration = pink.Configuration(BODY.model, BODY.model.createData(), np.array((0.0, 0.0, 0.0, x, y, z, w)))
    task = pink.FrameTask("body", position_cost=1.0, orientation_cost=1.0, lm_damping=1.0)
    task.set_target(pinocchio.SE3.Identity())
    while True:
        x, y, z, w = configuration.q[3:]
        yield conjugate((w, x, y, z))
        velocity = pink.solve_ik(configuration, [task], DT_S, solver="daqp")
        configuration.integrate_inplace(velocity, DT_S)


LIBRARY = Library(
    "pink",
    "pin-pink",
    (Function("FrameTask.compute_error", MATRIX, frame_task),),
    (
        Controller(
            "solve_ik, FrameTask",
            "FrameTask.compute_error",
            "velocity",
            "gain 1, lm_damping 1, 200 Hz",
            DT_S,
            solved,
        ),
    ),
)
