"""Pink: the error of its FrameTask, on Pinocchio's logarithm of a pose."""

import numpy as np
import pink
import pinocchio

from bench.studies.libraries.library import MATRIX, Function, Library


def free_flyer() -> pink.Configuration:
    """A body that floats, at the identity."""
    model = pinocchio.Model()
    model.addJoint(0, pinocchio.JointModelFreeFlyer(), pinocchio.SE3.Identity(), "root")
    model.addFrame(pinocchio.Frame("body", 1, 0, pinocchio.SE3.Identity(), pinocchio.FrameType.BODY))
    return pink.Configuration(model, model.createData(), pinocchio.neutral(model))


BODY = free_flyer()


def frame_task(R) -> np.ndarray:
    """FrameTask.compute_error of a body at the identity whose target is turned; its angular part."""
    task = pink.FrameTask("body", position_cost=1.0, orientation_cost=1.0)
    task.set_target(pinocchio.SE3(R, np.zeros(3)))
    return task.compute_error(BODY)[3:]


LIBRARY = Library("pink", "pin-pink", (Function("FrameTask.compute_error", MATRIX, frame_task),))
