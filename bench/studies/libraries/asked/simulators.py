"""MuJoCo and what runs on it, and Newton: their functions, and what actuators, constraints and solvers make of them."""

import functools
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from bench.studies.libraries.closed_loop import conjugate
from bench.studies.libraries.library import MATRIX, QUATERNION, Controller, Function, Tested, library, vector_part

BALL = """
<body name="body"><joint type="ball"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><site name="body"/></body>
"""
MODELS = {
    "alone": f"<mujoco><worldbody>{BALL}</worldbody></mujoco>",
    "actuated": f"""<mujoco><worldbody><site name="goal"/>{BALL}</worldbody>
    <actuator><orientation site="body" refsite="goal" kp="1"/></actuator></mujoco>""",
    "held": f"""<mujoco><option timestep="0.001" gravity="0 0 0"/><worldbody><site name="goal"/>{BALL}</worldbody>
    <actuator><orientation site="body" refsite="goal" kp="100" kv="20"/></actuator></mujoco>""",
    "welded": f"""<mujoco><option gravity="0 0 0"/><worldbody><body name="goal" mocap="true"/>{BALL}</worldbody>
    <equality><weld body1="goal" body2="body" relpose="0 0 0 1 0 0 0"/></equality></mujoco>""",
}
"""A body of unit inertia on a ball joint: alone, with the goal's actuators, with their gains, welded to the goal."""


@functools.cache
def load_model(name: str) -> Any:
    """Compile a model of MODELS and return it with its data."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(MODELS[name])
    return model, mujoco.MjData(model)


def place_body(name: str, q: Any) -> Any:
    """Return the data of a model with its body at an orientation, at rest."""
    import mujoco

    model, data = load_model(name)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    return data


@library("mujoco")
def mujoco() -> Iterator[Tested]:
    """Yield MuJoCo's functions on quaternions, its <orientation> actuator and its <weld>."""
    import mujoco

    def stepped(name: str, q: np.ndarray) -> Iterator[tuple]:  # from rest until it neither moves nor accelerates
        model, _ = load_model(name)
        data = mujoco.MjData(model)
        data.qpos[:] = conjugate(q)
        while True:
            yield conjugate(tuple(data.qpos))
            mujoco.mj_step(model, data)
            if not data.qvel.any() and not data.qacc.any():
                return

    identity = np.array((1.0, 0.0, 0.0, 0.0))

    def filled(size: int, function: Any, *given: Any) -> np.ndarray:
        found = np.empty(size)
        function(found, *given)
        return found

    def mat_to_quat(R: np.ndarray) -> np.ndarray:
        return filled(4, mujoco.mju_mat2Quat, np.ascontiguousarray(R).ravel())

    def quat_to_vel(q: np.ndarray) -> np.ndarray:
        return filled(3, mujoco.mju_quat2Vel, q, 1.0)

    # minus the force of three actuators with kp = 1, in the frame of the body
    actuator = Function("<orientation> actuator", QUATERNION, lambda q: -place_body("actuated", q).qfrc_actuator)
    yield Function("mju_subQuat", QUATERNION, lambda q: filled(3, mujoco.mju_subQuat, q, identity))
    yield Function("mju_quat2Vel", QUATERNION, quat_to_vel)
    yield Function("mju_mat2Quat, mju_quat2Vel", MATRIX, lambda R: quat_to_vel(mat_to_quat(R)))
    yield vector_part("mju_mat2Quat", lambda R: 2.0 * mat_to_quat(R)[1:], "`mju_quat2Vel` of it")
    yield actuator

    def numbers(values: Any) -> str:
        return " ".join(f"{value:g}" for value in values)

    def stepping(model: str, name: str, error: str, title: str, **more: Any) -> Controller:
        dt_s = load_model(model)[0].opt.timestep
        return Controller(name, error, "acceleration", title, dt_s, partial(stepped, model), **more)

    weld, _ = load_model("welded")
    title = f"solref {numbers(weld.eq_solref[0])}, solimp {numbers(weld.eq_solimp[0])}, "
    title += f"timestep {1e3 * weld.opt.timestep:g} ms"
    yield stepping("held", "<orientation> actuators", actuator.name, "kp 100, kv 20, timestep 1 ms")
    yield stepping("welded", "<weld>, by default", "", title, pull=lambda q: place_body("welded", q).qacc.copy())


@library("mink")
def mink() -> Iterator[Tested]:
    """Yield mink's logarithm in Python, the one in C that its FrameTask takes where it is compiled, and solve_ik."""
    import mink
    from mink.lie import _lie_ops_c

    (model, _), dt_s = load_model("alone"), 0.005
    at_identity = mink.Configuration(model)

    def task_to(pose: Any, **options: Any) -> Any:
        task = mink.FrameTask("body", "body", position_cost=1.0, orientation_cost=1.0, **options)
        task.set_target(pose)
        return task

    def error(q: np.ndarray) -> np.ndarray:  # of a body at the identity whose target is turned
        return task_to(mink.SE3.from_rotation(mink.SO3(np.array(q)))).compute_error(at_identity)[3:]

    def solved(q: np.ndarray) -> Iterator[tuple]:  # tick by tick, as in mink's examples, towards the identity
        configuration = mink.Configuration(model, q=np.array(conjugate(q)))
        task = task_to(mink.SE3.identity(), lm_damping=1.0)
        while True:
            yield conjugate(tuple(configuration.q))
            velocity = mink.solve_ik(configuration, [task], dt_s, "daqp", damping=1e-3)
            configuration.integrate_inplace(velocity, dt_s)

    def log_of_matrix(R: np.ndarray) -> np.ndarray:
        return _lie_ops_c.se3_log(_lie_ops_c.xmat_xpos_to_wxyz_xyz(np.ravel(R), np.zeros(3)))[3:]

    own = Function("FrameTask.compute_error", QUATERNION, error)
    yield Function(
        "SO3.log (Python)",
        QUATERNION,
        lambda q: mink.SO3(np.array(q)).log(),
        fix="`np.copysign(1.0, q[0])` for `np.sign(q[0])`",
        thread="kevinzakka/mink#82",
    )
    yield Function("se3_log (compiled)", QUATERNION, lambda q: _lie_ops_c.se3_log(np.array((*q, 0.0, 0.0, 0.0)))[3:])
    yield Function("se3_log (compiled), of a matrix", MATRIX, log_of_matrix)
    yield own
    title = "gain 1, lm_damping 1, damping 1e-3, 200 Hz"
    yield Controller("solve_ik, FrameTask", own.name, "velocity", title, dt_s, solved)


@library("newton", is_single=True)
def newton() -> Iterator[Tested]:
    """Yield the errors of Newton's controllers and inverse kinematics, and axis and angle of its Warp, on the CPU."""
    import newton
    import warp
    from newton._src.controllers.impl._common import _pose_error_kernel

    @warp.kernel
    def axis_angle(given: warp.array(dtype=warp.quat), e: warp.array(dtype=warp.vec3)) -> None:  # type: ignore[valid-type]
        axis, angle = warp.vec3(), float(0.0)  # noqa: UP018 - to Warp float(0.0) is a variable, 0.0 a constant
        warp.quat_to_axis_angle(given[0], axis, angle)
        e[0] = angle * axis

    @warp.kernel
    def of_matrix(given: warp.array(dtype=warp.mat33), e: warp.array(dtype=warp.vec3)) -> None:  # type: ignore[valid-type]
        axis, angle = warp.vec3(), float(0.0)  # noqa: UP018
        warp.quat_to_axis_angle(warp.quat_from_matrix(given[0]), axis, angle)
        e[0] = angle * axis

    def on_cpu(values: Any, dtype: Any) -> Any:
        return warp.array(values, dtype=dtype, device="cpu")

    def launched(kernel: Any, given: list, dtype: Any = warp.vec3) -> np.ndarray:
        found = warp.zeros(1, dtype=dtype, device="cpu")
        warp.launch(kernel, dim=1, inputs=given, outputs=[found], device="cpu")
        return found.numpy()[0]

    def pose(quat_xyzw: Any) -> np.ndarray:
        return np.array([(0.0, 0.0, 0.0, *quat_xyzw)], dtype=np.float32)

    def pose_error(q: np.ndarray) -> np.ndarray:  # the angular part
        poses = [on_cpu(pose(one), warp.transform) for one in ((0.0, 0.0, 0.0, 1.0), q[order])]
        return launched(_pose_error_kernel, poses, warp.spatial_vector)[3:]

    builder, order = newton.ModelBuilder(), [1, 2, 3, 0]
    builder.add_body(mass=1.0)
    model = builder.finalize(device="cpu")
    goal = on_cpu([warp.vec4(0.0, 0.0, 0.0, 1.0)], warp.vec4)
    objective = newton.ik.IKObjectiveRotation(0, warp.quat_identity(), goal)
    residuals = warp.zeros((1, 3), dtype=warp.float32, device="cpu")
    first = warp.zeros(1, dtype=warp.int32, device="cpu")
    objective.set_batch_layout(3, 0, 1)
    objective.bind_device(model.device)
    objective.init_buffers(model, newton.ik.IKJacobianType.ANALYTIC)

    def residual(q: np.ndarray) -> np.ndarray:  # of one free body whose goal is the identity: at T it is T's error
        bodies = on_cpu(pose(q[order])[None], warp.transform)
        objective.compute_residuals(bodies, None, model, residuals, 0, first)
        return residuals.numpy()[0]

    by_matrix = "warp.quat_from_matrix, quat_to_axis_angle"
    yield Function("controllers: _pose_error_kernel", QUATERNION, pose_error)
    yield Function("ik.IKObjectiveRotation, residual", QUATERNION, residual)
    yield Function(
        "warp.quat_to_axis_angle", QUATERNION, lambda q: launched(axis_angle, [on_cpu([q[order]], warp.quat)])
    )
    yield Function(by_matrix, MATRIX, lambda R: launched(of_matrix, [on_cpu([R], warp.mat33)]))
