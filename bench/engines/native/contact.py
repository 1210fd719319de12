"""A task in contact as compiled code takes it: addresses of mjData's arrays and of buffers, and arrays made of them."""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from bench.control.setpoint import ContactBuffers, ContactParameters, Rows, Setpoint
from bench.engines.arm_episode import MOST
from bench.engines.compiled import GAINS, MATRIX, ROTATION, THREE, float64, int64, types
from bench.engines.contact_episode import (
    Numbers,
    sensors_of,
)
from bench.engines.native.arm import CHAIN, VECTOR
from bench.engines.native.pointers import address_of, integers, matrix, vector
from bench.law.resolved_motion import Scratch
from bench.law.scalar import kernel
from tasks.contact import MOST_LEGS
from tasks.contact_rest import RestNumbers


class ContactView(NamedTuple):
    """One mjData of a contact task as compiled code takes it: addresses and sizes.

    nv: degrees of freedom, the arm's n first; gap, turned: places among the sensor values, -1 if there is none.
    asked: three integers that say what to step (see `trapped`).
    """

    model: int
    data: int
    is_runge_kutta: int
    n: int
    nv: int
    sensors: int
    gap: int
    turned: int
    batch: int
    callback: int
    asked: int
    push: int
    qvel: int
    ctrl: int
    sensordata: int
    bias: int
    passive: int
    axes: int
    anchors: int


class Workspace(NamedTuple):
    """Addresses of the buffers of `Rows` and `ContactBuffers`, and of J, D (nv x nv), fg, tau, legs, noise.

    legs: the trial's pushes. noise: the sensor's, ticks x 6.
    """

    a: int
    drift: int
    F: int
    h: int
    v: int
    y: int
    b: int
    x: int
    held: int
    A: int
    B: int
    V: int
    s: int
    t: int
    J: int
    D: int
    fg: int
    tau: int
    legs: int
    noise: int


SIX = types.UniTuple(float64, 6)
SEVEN = types.UniTuple(float64, MOST)
WISH = types.NamedTuple((ROTATION, THREE, THREE, THREE, THREE), Setpoint)
TOUCH = types.NamedUniTuple(float64, len(ContactParameters._fields), ContactParameters)
ROWS = types.NamedUniTuple(VECTOR, len(Rows._fields), Rows)
FOUR = types.UniTuple(float64, 4)
REST = types.NamedTuple((int64, int64, float64, float64), RestNumbers)
NUMBERS = types.NamedTuple(
    (float64, int64, int64, float64, float64, SIX, FOUR, THREE, THREE, THREE, SEVEN, int64, float64, int64, REST),
    Numbers,
)
VIEW = types.NamedUniTuple(int64, len(ContactView._fields), ContactView)
WORKSPACE = types.NamedUniTuple(int64, len(Workspace._fields), Workspace)
ASSEMBLE = types.void(CHAIN, WISH, THREE, THREE, GAINS, TOUCH, MATRIX, ROWS)


def view(model, data, batch, callback: int, asked: np.ndarray, n: int) -> ContactView:
    """The view of one simulation; `data`, `batch` and `asked` must outlive it."""
    asked[:2] = model._address, data._address
    arrays = (data.qvel, data.ctrl, data.sensordata, data.qfrc_bias, data.qfrc_passive, data.xaxis, data.xanchor)
    gap, turned = sensors_of(model)
    return ContactView(
        model._address,
        data._address,
        int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4),
        n,
        model.nv,
        model.nsensordata,
        gap,
        turned,
        batch.address,
        callback,
        address_of(asked),
        address_of(data.xfrc_applied[model.body("hand").id]),
        *map(address_of, arrays),
    )


def workspace(rows: Rows, room: ContactBuffers, nv: int, n: int, noise: np.ndarray) -> tuple[Workspace, tuple]:
    """The addresses of a controller's buffers, and the arrays, to be kept."""
    arrays = (
        *rows, room.y, room.b, room.x, room.held, *room.scratch,
        np.zeros((6, MOST)), np.zeros((nv, nv)), np.zeros(n), np.zeros(n), np.zeros((MOST_LEGS, 6)), noise,
    )  # fmt: skip
    return Workspace(*map(address_of, arrays)), arrays


class Body(NamedTuple):
    """The arrays of `ContactView` and `Workspace`, and what of them stays a number."""

    model: int
    data: int
    is_runge_kutta: int
    n: int
    nv: int
    gap: int
    turned: int
    batch: int
    callback: int
    asked_address: int
    D_address: int
    asked: Any
    push: Any
    qvel: Any
    ctrl: Any
    s: Any
    bias: Any
    passive: Any
    axes: Any
    anchors: Any
    J: Any
    D: Any
    fg: Any
    tau: Any
    legs: Any
    noise: Any
    rows: Rows
    room: ContactBuffers


@kernel
def open_simulation(sim, work, ticks):
    """Return the arrays of a simulation and its buffers."""
    n, nv = sim.n, sim.nv
    A, B, V = matrix(work.A, MOST, MOST), matrix(work.B, MOST, MOST), matrix(work.V, MOST, MOST)
    scratch = Scratch(A, B, V, vector(work.s, MOST), vector(work.t, MOST))
    y, b, x, held = vector(work.y, MOST), vector(work.b, MOST), vector(work.x, MOST), matrix(work.held, 6, MOST)
    return Body(
        sim.model, sim.data, sim.is_runge_kutta, n, nv, sim.gap, sim.turned, sim.batch, sim.callback, sim.asked, work.D,
        integers(sim.asked, 3), vector(sim.push, 6), vector(sim.qvel, nv), vector(sim.ctrl, n),
        vector(sim.sensordata, sim.sensors), vector(sim.bias, nv), vector(sim.passive, nv),
        matrix(sim.axes, nv, 3), matrix(sim.anchors, nv, 3),
        matrix(work.J, 6, MOST), matrix(work.D, nv, nv), vector(work.fg, n), vector(work.tau, n),
        matrix(work.legs, MOST_LEGS, 6), matrix(work.noise, ticks, 6),
        Rows(vector(work.a, 6), vector(work.drift, 6), vector(work.F, 6), vector(work.h, 6), vector(work.v, 6)),
        ContactBuffers(y, b, x, held, scratch),
    )  # fmt: skip
