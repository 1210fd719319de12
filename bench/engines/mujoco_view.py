"""One mjData for the loop, and what is done with it: compiled by MuJoCo's C functions, plain by dm_control's own loop.

Compiled, model and data are addresses; the order is dm_control's with legacy_step=True, mj_step1 | law | mj_step2,
mj_step1 | law | ... (with Runge-Kutta mj_step in place of mj_step2, which would silently be Euler). mjData's arrays
never move. Plain, data is a dm_control Environment and ctrl a buffer of the action, or, of the controller's model,
MuJoCo's own model and data.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numba.extending import overload

from bench.engines.arrays import Matrix, Vector
from bench.engines.native.libmujoco import mj_fullM as full_inertia
from bench.engines.native.libmujoco import mj_fwdActuation, mj_resetData, mj_step, mj_step1, mj_step2
from bench.engines.typed import PART
from bench.translation.dialect import REPLACED


class Simulated(NamedTuple):
    """One mjData: its arrays, n the number of joints, and the speed and force of each degree of freedom."""

    model: int
    data: int
    is_runge_kutta: int
    n: int
    qpos: Vector
    qvel: Vector
    ctrl: Vector
    sensordata: Vector
    qfrc_bias: Vector
    qfrc_passive: Vector
    qfrc_actuator: Vector
    xaxis: Matrix
    xanchor: Matrix


ARRAYS = Simulated._fields[4:]


def compiled_view(model: Any, data: Any) -> Simulated:
    """Return one simulation for compiled code; `data` must outlive it."""
    is_runge_kutta = int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4)
    return Simulated(model._address, data._address, is_runge_kutta, model.nv, *(getattr(data, one) for one in ARRAYS))


def plain_view(environment: Any) -> Simulated:
    """Return a dm_control environment that has been reset."""
    physics = environment.physics
    view = model_view(physics.model.ptr, physics.data.ptr)
    return view._replace(data=environment, ctrl=np.zeros(physics.model.nu))


def model_view(model: Any, data: Any) -> Simulated:
    """Return MuJoCo's own model and data."""
    return Simulated(model, data, 0, model.nv, *(getattr(data, one) for one in ARRAYS))


def place(body, states, k):
    """Put a simulation into a state (qpos, qvel); a dm_control environment is there already."""
    return None


def step(body):
    """Let MuJoCo step, and compute what follows from the state."""
    body.data.step(body.ctrl.copy())


def compute(body):
    """Compute what follows from the state of a controller's model."""
    mujoco.mj_step1(body.model, body.data)


def actuate(body):
    """Compute the forces of actuators."""
    body.data.physics.set_control(body.ctrl)
    mujoco.mj_fwdActuation(body.data.physics.model.ptr, body.data.physics.data.ptr)


def fill_inertia(body, D):
    """Fill the inertia matrix."""
    data = body.data.physics.data.ptr if hasattr(body.data, "physics") else body.data
    mujoco.mj_fullM(body.model, data, D)


def in_compiled_code(function: Callable) -> Callable:
    """Mark the kernel that does in compiled code what a function does in Python."""

    def mark(kernel: Callable) -> Callable:
        REPLACED[function] = kernel
        overload(function, jit_options=PART | {"forceinline": True}, strict=False)(lambda *kinds: kernel)
        return kernel

    return mark


@in_compiled_code(place)
def _place(body, states, k):
    nq, nv = body.qpos.shape[0], body.qvel.shape[0]
    mj_resetData(body.model, body.data)
    for i in range(nq):
        body.qpos[i] = states[k, i]
    for i in range(nv):
        body.qvel[i] = states[k, nq + i]
    mj_step1(body.model, body.data)


@in_compiled_code(step)
def _step(body):
    if body.is_runge_kutta:
        mj_step(body.model, body.data)
    else:
        mj_step2(body.model, body.data)
    mj_step1(body.model, body.data)


@in_compiled_code(compute)
def _compute(body):
    mj_step1(body.model, body.data)


@in_compiled_code(actuate)
def _actuate(body):
    mj_fwdActuation(body.model, body.data)


@in_compiled_code(fill_inertia)
def _fill_inertia(body, D):
    full_inertia(body.model, body.data, D.ctypes.data)
