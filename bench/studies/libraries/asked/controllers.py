"""Libraries of kinematics and control: their errors, and their controllers as their users run them.

The requirements of PlaCo and of robosuite contradict those of the others; either runs in an environment of its own.
"""

import json
import math
import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from bench.studies.libraries.closed_loop import accelerated, conjugate, driven
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Tested, library, vector_part

LINK = """<robot name="body"><link name="body"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>"""


@library("drake")
def drake() -> Iterator[Tested]:
    """Yield pydrake.math, its binding of Eigen's AngleAxis, and DoDifferentialInverseKinematics of a floating body.

    Its inverse dynamics controller knows joints alone, and so no orientation error.
    """
    from pydrake.common.eigen_geometry import AngleAxis, Quaternion
    from pydrake.math import RigidTransform, RollPitchYaw, RotationMatrix
    from pydrake.multibody.inverse_kinematics import (
        DifferentialInverseKinematicsParameters,
        DoDifferentialInverseKinematics,
    )
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.multibody.tree import SpatialInertia, UnitInertia

    dt_s, plant = 0.01, MultibodyPlant(0.0)
    plant.AddRigidBody("body", SpatialInertia(1.0, np.zeros(3), UnitInertia(1.0, 1.0, 1.0)))
    plant.Finalize()
    context, body = plant.CreateDefaultContext(), plant.GetFrameByName("body")
    parameters = DifferentialInverseKinematicsParameters(plant.num_positions(), plant.num_velocities())
    parameters.set_time_step(dt_s)

    def solved(T: np.ndarray) -> np.ndarray:  # the body is at T^T, the goal is the identity
        plant.SetFreeBodyPose(context, plant.get_body(body.body().index()), RigidTransform(RotationMatrix(T.T)))
        found = DoDifferentialInverseKinematics(plant, context, RigidTransform(), body, parameters)
        return np.zeros(3) if found.joint_velocities is None else found.joint_velocities[:3]

    def vector(found: AngleAxis) -> np.ndarray:
        return found.angle() * found.axis()

    def unit(q: np.ndarray) -> Quaternion:  # Drake refuses what is not of length 1 to 1e-14
        return Quaternion(q / np.linalg.norm(q))

    of_matrix = Function("RotationMatrix.ToAngleAxis", MATRIX, lambda R: vector(RotationMatrix(R).ToAngleAxis()))
    yield of_matrix
    yield Function("AngleAxis, of a quaternion", QUATERNION, lambda q: vector(AngleAxis(unit(q))))
    yield vector_part("RotationMatrix.ToQuaternion", lambda R: 2.0 * RotationMatrix(R).ToQuaternion().xyz())
    yield Function("RollPitchYaw", MATRIX, lambda R: RollPitchYaw(RotationMatrix(R)).vector(), "z-y-x")
    title, motion = "time step 10 ms, no limits", partial(driven, solved, dt_s)
    yield Controller("DoDifferentialInverseKinematics", of_matrix.name, "velocity", title, dt_s, motion)


@library("pin-pink")
def pink() -> Iterator[Tested]:
    """Yield the error of Pink's FrameTask, on Pinocchio's logarithm of a pose, and its solve_ik."""
    import pink
    import pinocchio

    model, dt_s = pinocchio.Model(), 0.005
    model.addJoint(0, pinocchio.JointModelFreeFlyer(), pinocchio.SE3.Identity(), "root")
    model.addFrame(pinocchio.Frame("body", 1, 0, pinocchio.SE3.Identity(), pinocchio.FrameType.BODY))
    body = pink.Configuration(model, model.createData(), pinocchio.neutral(model))

    def error(R: np.ndarray) -> np.ndarray:  # the angular part, of a body at the identity whose target is turned
        task = pink.FrameTask("body", position_cost=1.0, orientation_cost=1.0)
        task.set_target(pinocchio.SE3(R, np.zeros(3)))
        return task.compute_error(body)[3:]

    def solved(q: np.ndarray) -> Iterator[tuple]:  # tick by tick, as in Pink's examples, towards the identity
        w, x, y, z = conjugate(q)
        configuration = pink.Configuration(body.model, body.model.createData(), np.array((0.0, 0.0, 0.0, x, y, z, w)))
        task = pink.FrameTask("body", position_cost=1.0, orientation_cost=1.0, lm_damping=1.0)
        task.set_target(pinocchio.SE3.Identity())
        while True:
            x, y, z, w = configuration.q[3:]
            yield conjugate((w, x, y, z))
            velocity = pink.solve_ik(configuration, [task], dt_s, solver="daqp")
            configuration.integrate_inplace(velocity, dt_s)

    name, title = "FrameTask.compute_error", "gain 1, lm_damping 1, 200 Hz"
    yield Function(name, MATRIX, error)
    yield Controller("solve_ik, FrameTask", name, "velocity", title, dt_s, solved)


@library("placo")
def placo() -> Iterator[Tested]:
    """Yield the error of PlaCo's OrientationTask, and its kinematics solver as its users run it."""
    import placo
    from pinocchio import Quaternion

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "body.urdf"
        file.write_text(LINK, encoding="utf-8")
        robot = placo.RobotWrapper(str(file), placo.Flags.ignore_collisions)
    solver = placo.KinematicsSolver(robot)
    task = solver.add_orientation_task("body", np.eye(3))

    def place(R: np.ndarray) -> None:
        T = np.eye(4)
        T[:3, :3] = R
        robot.set_T_world_frame("body", T)
        robot.update_kinematics()

    def error(R: np.ndarray) -> np.ndarray:  # the task's b: the rotation asked for, of a body at the identity
        place(np.eye(3))
        task.R_world_frame = R
        task.update()
        return task.b.ravel()

    def solved(q: np.ndarray) -> Iterator[tuple]:
        task.R_world_frame = np.eye(3)
        place(Quaternion(*conjugate(q)).toRotationMatrix())
        while True:
            left = Quaternion(robot.get_T_world_frame("body")[:3, :3].T.copy())
            yield (left.w, left.x, left.y, left.z)
            solver.solve(True)
            robot.update_kinematics()

    name, title = "OrientationTask", "solve(True), weight 1"
    yield Function(name, MATRIX, error)
    yield Controller("KinematicsSolver, OrientationTask", name, "velocity", title, 0.01, solved)


@library("roboticstoolbox-python")
def roboticstoolbox() -> Iterator[Tested]:
    """Yield what the servo and the inverse kinematics of Robotics Toolbox for Python take for the error."""
    import roboticstoolbox
    from spatialmath import base

    dt_s, servo = 0.05, roboticstoolbox.p_servo

    def of_servo(name: str, method: str, form: str) -> Iterator[Tested]:
        def error(R: np.ndarray) -> np.ndarray:
            return servo(np.eye(4), base.r2t(R), method=method)[0][3:]

        def velocity(T: np.ndarray) -> np.ndarray:  # p_servo gives it in the frame of the tool
            return T.T @ servo(base.r2t(T.T), np.eye(4), gain=1.0, method=method)[0][3:]

        yield Function(name, MATRIX, error, form)
        yield Controller(name, name, "velocity", "gain 1, 20 Hz", dt_s, partial(driven, velocity, dt_s))

    yield Function("angle_axis", MATRIX, lambda R: roboticstoolbox.angle_axis(np.eye(4), base.r2t(R))[3:])
    yield from of_servo('p_servo(method="angle-axis")', "angle-axis", "rotation-vector")
    yield from of_servo("p_servo, by default", "rpy", "z-y-x")


@library("robosuite")
def robosuite() -> Iterator[Tested]:
    """Yield the error of robosuite's operational-space controller, in our loop with the gains of OSC_POSE.

    As delivered they are kp 150, damping_ratio 1, and control at the simulation's 500 Hz.
    """
    import robosuite
    from robosuite.utils import transform_utils
    from robosuite.utils.control_utils import orientation_error

    kp, kv, dt_s = 150.0, 2.0 * math.sqrt(150.0), 0.002
    file = Path(robosuite.__file__).parent / "controllers/config/robots/default_panda.json"
    arm = json.loads(file.read_text(encoding="utf-8"))["body_parts"]["arms"]["right"]
    if arm["input_type"] != "delta":
        raise ValueError(f"{file} sets input_type {arm['input_type']}; this function is written for delta")
    delta = arm["output_max"][3]  # rad, the largest about each axis in one command
    to_vector = transform_utils.quat2axisangle  # takes (x, y, z, w)
    error = Function("orientation_error", MATRIX, lambda R: orientation_error(R, np.eye(3)), "sine")
    yield error
    yield Function("quat2axisangle", QUATERNION, lambda q: to_vector(q[[1, 2, 3, 0]]))
    yield Function("mat2quat, quat2axisangle", MATRIX, lambda R: to_vector(transform_utils.mat2quat(R)))
    title = f"kp 150, damping ratio 1, 500 Hz; input as delivered: a delta of at most {delta:g} rad"
    motion, name = partial(accelerated, error, kp, kv, dt_s), "OSC_POSE, rotation decoupled"
    yield Controller(name, error.name, "acceleration", title, dt_s, motion, is_our_loop=True)
