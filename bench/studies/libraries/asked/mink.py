"""mink: the logarithm in Python, and the one in C that its FrameTask takes where it is compiled; its solve_ik."""

from collections.abc import Iterator

import mink
import mujoco
import numpy as np
from mink.lie import _lie_ops_c

from bench.studies.libraries.free_body import conjugate
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Library

MODEL = mujoco.MjModel.from_xml_string("""
<mujoco><worldbody><body name="body"><joint type="ball"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
</worldbody></mujoco>
""")
DT_S = 0.005
AT_IDENTITY = mink.Configuration(MODEL)


def python_log(quat_wxyz) -> np.ndarray:
    """SO3.log."""
    return mink.SO3(np.array(quat_wxyz)).log()


def compiled_log(quat_wxyz) -> np.ndarray:
    """se3_log of _lie_ops_c, the angular part."""
    return _lie_ops_c.se3_log(np.array((*quat_wxyz, 0.0, 0.0, 0.0)))[3:]


def compiled_log_of_matrix(R) -> np.ndarray:
    """xmat_xpos_to_wxyz_xyz, then se3_log."""
    return _lie_ops_c.se3_log(_lie_ops_c.xmat_xpos_to_wxyz_xyz(np.ravel(R), np.zeros(3)))[3:]


def frame_task(quat_wxyz) -> np.ndarray:
    """FrameTask.compute_error of a body at the identity whose target is turned; its angular part."""
    task = mink.FrameTask("body", "body", position_cost=1.0, orientation_cost=1.0)
    task.set_target(mink.SE3.from_rotation(mink.SO3(np.array(quat_wxyz))))
    return task.compute_error(AT_IDENTITY)[3:]


def solved(quat_wxyz) -> Iterator[tuple]:
    """solve_ik and integrate_inplace tick by tick, as in mink's examples, towards the identity."""
    configuration = mink.Configuration(MODEL, q=np.array(conjugate(quat_wxyz)))
    task = mink.FrameTask("body", "body", position_cost=1.0, orientation_cost=1.0, lm_damping=1.0)
    task.set_target(mink.SE3.identity())
    while True:
        yield conjugate(tuple(configuration.q))
        velocity = mink.solve_ik(configuration, [task], DT_S, "daqp", damping=1e-3)
        configuration.integrate_inplace(velocity, DT_S)


LIBRARY = Library(
    "mink",
    "mink",
    (
        Function(
            "SO3.log (Python)",
            QUATERNION,
            python_log,
            fix="`np.copysign(1.0, q[0])` for `np.sign(q[0])`",
            thread="kevinzakka/mink#82",
        ),
        Function("se3_log (compiled)", QUATERNION, compiled_log),
        Function("se3_log (compiled), of a matrix", MATRIX, compiled_log_of_matrix),
        Function("FrameTask.compute_error", QUATERNION, frame_task),
    ),
    (
        Controller(
            "solve_ik, FrameTask",
            "FrameTask.compute_error",
            "velocity",
            "gain 1, lm_damping 1, damping 1e-3, 200 Hz",
            DT_S,
            solved,
        ),
    ),
)
