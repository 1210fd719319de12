"""Buffers of doubles and of counting scalars, matrices of every kind to try kernels on, a serial arm of MuJoCo's."""

import functools
from typing import NamedTuple

import mujoco
import numpy as np

from bench.engines.compiled import compile_on_demand
from bench.engines.counting import Counted, Tally
from bench.law.chain import Chain, Scratch
from support.bits import same_bits
from support.states import as_rotation, vector

SIZE = 7


def buffer(array, dtype=float):
    """A larger buffer that holds the array in its corner, NaN elsewhere: nothing outside may be read."""
    array = np.asarray(array, dtype=float)
    held = np.full((SIZE,) * array.ndim, np.nan)
    held[tuple(slice(0, k) for k in array.shape)] = array
    return held if dtype is float else as_counted(held)


def as_counted(array):
    """Return the same numbers as counting scalars in an object array."""
    tally, array = Tally(), np.asarray(array)
    held = np.empty(array.shape, dtype=object)
    for at, number in np.ndenumerate(array):
        held[at] = Counted(number, tally)
    return held


def as_floats(array):
    """The doubles in a buffer of either kind."""
    values = [x.value if isinstance(x, Counted) else x for x in np.ravel(array)]
    return np.array(values, dtype=float).reshape(np.shape(array))


def scratch(dtype=float) -> Scratch:
    """Scratch full of NaN: what an inverse reads it must have written."""
    square, vector = np.full((SIZE, SIZE), np.nan), np.full(SIZE, np.nan)
    parts = [square, square, square, vector, vector]
    return Scratch(*(part.copy() if dtype is float else as_counted(part) for part in parts))


@functools.cache
def matrices(rows: int, n: int) -> dict:
    """Name -> matrix: well conditioned, graded, of every lower rank, with exact zeros, tiny, large, not finite."""
    draw = np.random.default_rng(20 * rows + n)
    least = min(rows, n)
    found = {f"random-{i}": draw.normal(size=(rows, n)) for i in range(8)}
    U, V = (np.linalg.qr(draw.normal(size=(k, k)))[0] for k in (rows, n))
    for k in (2, 6, 10, 14):
        sigma = np.zeros((rows, n))
        sigma[range(least), range(least)] = np.geomspace(1.0, 10.0**-k, least)
        found[f"graded-{k}"] = U @ sigma @ V.T
        sigma[range(least), range(least)] = 1.0
        sigma[least - 1, least - 1] = 10.0**-k
        found[f"nearly-singular-{k}"] = U @ sigma @ V.T
    for rank in range(1, least):
        found[f"rank-{rank}"] = draw.normal(size=(rows, rank)) @ draw.normal(size=(rank, n))
    found["zero"] = np.zeros((rows, n))
    found["zero-column"] = found["random-0"] * np.where(np.arange(n) == 2, 0.0, 1.0)
    found["equal-columns"] = found["random-1"][:, [0, 1, 1, *range(3, n)]]
    found["axes"] = np.roll(np.eye(max(rows, n))[:rows, :n], 1, axis=0)
    found["tiny"], found["large"] = 1e-60 * found["random-2"], 1e60 * found["random-3"]
    for word, number in (("nan", np.nan), ("inf", np.inf)):
        found[word] = found["random-4"].copy()
        found[word][1, 2] = number
    return found


def symmetric(rows: int) -> dict:
    """Name -> A A^T + a little I of the matrices: positive definite, but for those of no use."""
    with np.errstate(all="ignore"):
        return {word: A @ A.T + 1e-3 * np.eye(rows) for word, A in matrices(rows, rows).items()}


def state_of(model, q, qdot=0.0) -> mujoco.MjData:
    """Return what MuJoCo makes of a model at these joint angles and rates."""
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = q, qdot
    mujoco.mj_forward(model, data)
    return data


def jacobian_of(model, data, site: str) -> np.ndarray:
    """MuJoCo's 6 x n of a site, linear rows first."""
    J = np.zeros((6, model.nv))
    mujoco.mj_jacSite(model, data, J[:3], J[3:], model.site(site).id)
    return J


def bias_of(model, data, site: str) -> np.ndarray:
    """MuJoCo's Jdot qdot of a site."""
    Jdot, at = np.zeros((6, model.nv)), model.site(site).id
    mujoco.mj_jacDot(model, data, Jdot[:3], Jdot[3:], data.site_xpos[at], int(model.site_bodyid[at]))
    return Jdot @ data.qvel


def inertia_of(model, data) -> np.ndarray:
    """MuJoCo's D(q)."""
    D = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, D)
    return D


def chain_of(model, data, site: str) -> Chain:
    """What a controller of a site sees."""
    axes, anchors, rates = (part.copy() for part in (data.xaxis, data.xanchor, data.qvel))
    R = as_rotation(data.site(site).xmat.reshape(3, 3).T)
    return Chain(model.nv, axes, anchors, rates, vector(data.site(site).xpos), R)


class Arm(NamedTuple):
    """A serial arm of random hinges, its model and state by MuJoCo."""

    model: mujoco.MjModel
    data: mujoco.MjData

    def move(self, q, qdot) -> Chain:
        """To that state; what a controller then sees."""
        self.data.qpos[:], self.data.qvel[:] = q, qdot
        mujoco.mj_forward(self.model, self.data)
        return chain_of(self.model, self.data, "tool")

    @property
    def jacobian(self) -> np.ndarray:
        """MuJoCo's 6 x n, linear rows first."""
        return jacobian_of(self.model, self.data, "tool")


def serial_arm(n: int, seed: int = 3) -> Arm:
    """n hinges of random axes, anchors that are not their bodies' origins, links of 0.3 m or so."""
    draw = np.random.default_rng(seed)

    def text(numbers):
        return " ".join(repr(float(x)) for x in numbers)

    inside = '<site name="tool" pos="0.05 -0.1 0.2" quat="0.4 0.8 -0.2 0.4"/>'
    for i in reversed(range(n)):
        axis, anchor = draw.normal(size=3), draw.normal(scale=0.1, size=3)
        inside = (
            f'<body pos="{text(draw.normal(scale=0.2, size=3))}" quat="{text(draw.normal(size=4))}">'
            f'<joint name="j{i}" type="hinge" axis="{text(axis)}" pos="{text(anchor)}"/>'
            f'<inertial pos="0.05 0.02 -0.03" mass="1.5" diaginertia="0.02 0.03 0.025"/>{inside}</body>'
        )
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{inside}</worldbody></mujoco>")
    return Arm(model, mujoco.MjData(model))


def poses(n: int, count: int, seed: int = 4):
    """(arm, chain) at random joint positions and rates."""
    arm, draw = serial_arm(n), np.random.default_rng(seed)
    for _ in range(count):
        yield arm, arm.move(draw.uniform(-np.pi, np.pi, n), draw.normal(scale=2.0, size=n))


def of_numbers(part, dtype):
    """A chain, or any part of one, with counting scalars; as it is if floats are asked for."""
    if dtype is float or isinstance(part, int):
        return part
    if isinstance(part, np.ndarray):
        return as_counted(part)
    if isinstance(part, tuple):
        inside = [of_numbers(each, dtype) for each in part]
        return type(part)(*inside) if hasattr(part, "_fields") else tuple(inside)
    return Counted(part, Tally())


def numbers_of(answer) -> list:
    """Return the numbers in a tuple, or in a tuple of tuples."""
    if isinstance(answer, tuple):
        return [number for part in answer for number in numbers_of(part)]
    return [answer.value if isinstance(answer, Counted) else answer]


def different_calls(kernel, calls) -> list[tuple[int, str]]:
    """Return the calls for which the compiled or the counted kernel gives other bits than the plain one."""
    compiled, found = compile_on_demand(kernel), []
    with np.errstate(all="ignore"):
        for i, given in enumerate(calls):
            plain = numbers_of(kernel(*given))
            answers = {"compiled": compiled(*given), "counted": kernel(*of_numbers(given, object))}
            found += [(i, how) for how, answer in answers.items() if not same_bits(numbers_of(answer), plain)]
    return found
