"""PlaCo: the error of its OrientationTask, and its kinematics solver as its users run it.

Its requirements contradict those of the other libraries, so it is asked in an environment of its own.
"""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import placo
from pinocchio import Quaternion

from bench.studies.libraries.free_body import conjugate
from bench.studies.libraries.library import MATRIX, Controller, Function, Library

BODY = """<robot name="body"><link name="body"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>"""


def floating() -> placo.RobotWrapper:
    """One body that floats, at the identity."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "body.urdf"
        file.write_text(BODY, encoding="utf-8")
        return placo.RobotWrapper(str(file), placo.Flags.ignore_collisions)


ROBOT = floating()
SOLVER = placo.KinematicsSolver(ROBOT)
TASK = SOLVER.add_orientation_task("body", np.eye(3))
DT_S = 0.01


def place(R) -> None:
    """The body at an orientation."""
    T = np.eye(4)
    T[:3, :3] = R
    ROBOT.set_T_world_frame("body", T)
    ROBOT.update_kinematics()


def orientation_task(R) -> np.ndarray:
    """OrientationTask's b: the rotation asked for, of a body at the identity."""
    place(np.eye(3))
    TASK.R_world_frame = R
    TASK.update()
    return TASK.b.ravel()


def solved(quat_wxyz) -> Iterator[tuple]:
    """KinematicsSolver.solve(True) tick by tick; T is what is left to the identity."""
    TASK.R_world_frame = np.eye(3)
    place(Quaternion(*conjugate(quat_wxyz)).toRotationMatrix())
    while True:
        left = Quaternion(ROBOT.get_T_world_frame("body")[:3, :3].T.copy())
        yield (left.w, left.x, left.y, left.z)
        SOLVER.solve(True)
        ROBOT.update_kinematics()


LIBRARY = Library(
    "placo",
    "placo",
    (Function("OrientationTask", MATRIX, orientation_task),),
    (
        Controller(
            "KinematicsSolver, OrientationTask",
            "OrientationTask",
            "velocity",
            "solve(True), weight 1",
            DT_S,
            solved,
        ),
    ),
)
