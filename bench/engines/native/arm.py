"""An arm in MuJoCo as compiled code takes it: addresses of mjData's arrays and of buffers, and arrays made of them."""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from bench.control.resolved_acceleration import Buffers
from bench.engines.arm_episode import MOST, buffers
from bench.engines.compiled import FOUR, GAINS, GOAL, MATRIX, ROTATION, THREE, float64, int64, types
from bench.engines.native.pointers import address_of, matrix, vector
from bench.law.resolved_motion import Chain, Scratch
from bench.law.scalar import kernel


class ArmView(NamedTuple):
    """One mjData of an arm as compiled code takes it: addresses, and the numbers of joints and of sensor values."""

    model: int
    data: int
    is_runge_kutta: int
    n: int
    sensors: int
    qpos: int
    qvel: int
    ctrl: int
    sensordata: int
    bias: int
    passive: int
    axes: int
    anchors: int


class Workspace(NamedTuple):
    """Addresses of `Buffers`, their scratch, D, fg and a Jacobian for the judge's look; the number of joints."""

    J: int
    a: int
    x: int
    tau: int
    A: int
    B: int
    V: int
    s: int
    t: int
    D: int
    fg: int
    G: int
    n: int


VECTOR = float64[::1]
CHAIN = types.NamedTuple((int64, MATRIX, MATRIX, VECTOR, THREE, ROTATION), Chain)
SCRATCH = types.NamedTuple((MATRIX, MATRIX, MATRIX, VECTOR, VECTOR), Scratch)
ARM_VIEW = types.NamedUniTuple(int64, len(ArmView._fields), ArmView)
ASSEMBLE = types.Tuple((THREE, FOUR))(CHAIN, GOAL, THREE, GAINS, FOUR, MATRIX, VECTOR)
RESOLVE = types.void(MATRIX, VECTOR, MATRIX, VECTOR, int64, int64, SCRATCH)
WORKSPACE = types.NamedUniTuple(int64, len(Workspace._fields), Workspace)


def view(model, data) -> ArmView:
    """Return the view of one simulation; `data` must outlive it."""
    arrays = (
        *(data.qpos, data.qvel, data.ctrl, data.sensordata, data.qfrc_bias, data.qfrc_passive),
        *(data.xaxis, data.xanchor),
    )
    return ArmView(
        model._address,
        data._address,
        int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4),
        model.nv,
        model.nsensordata,
        *map(address_of, arrays),
    )


def workspace(n: int) -> tuple[Workspace, tuple]:
    """Return the addresses of fresh buffers for n joints, and the arrays, to be kept."""
    into = buffers(n)
    arrays = (*into[:4], *into.scratch, np.zeros((n, n)), np.zeros(n), np.zeros((MOST, MOST)))
    return Workspace(*[*map(address_of, arrays), n]), arrays


class Body(NamedTuple):
    """One mjData as kernels take it: arrays at the addresses of `ArmView`."""

    model: int
    data: int
    is_runge_kutta: int
    n: int
    q: Any
    qdot: Any
    ctrl: Any
    s: Any
    bias: Any
    passive: Any
    axes: Any
    anchors: Any


@kernel
def open_view(view):
    """Return the arrays of a view."""
    n = view.n
    return Body(
        view.model, view.data, view.is_runge_kutta, n,
        vector(view.qpos, n), vector(view.qvel, n), vector(view.ctrl, n), vector(view.sensordata, view.sensors),
        vector(view.bias, n), vector(view.passive, n), matrix(view.axes, n, 3), matrix(view.anchors, n, 3),
    )  # fmt: skip


@kernel
def open_workspace(work):
    """Return the buffers of a workspace."""
    A, B, V = matrix(work.A, MOST, MOST), matrix(work.B, MOST, MOST), matrix(work.V, MOST, MOST)
    scratch = Scratch(A, B, V, vector(work.s, MOST), vector(work.t, MOST))
    J, a, x = matrix(work.J, MOST, MOST), vector(work.a, MOST), vector(work.x, MOST)
    return Buffers(J, a, x, vector(work.tau, work.n), scratch)
