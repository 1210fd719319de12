"""A rigid body whose inertia is not the controller's model of it, moved by a torque that is held."""

from bench.engines.ideal import held_step, rk4_step
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import cross, dot, rotate, rotate_back


@kernel
def bounded(u, bound):
    """u, shortened to the bound if it is longer."""
    squared = dot(u, u)
    if squared > bound * bound:
        scale = bound / sqrt(squared)
        return (scale * u[0], scale * u[1], scale * u[2])
    return u


@kernel
def uneven_acceleration(R, omega, u, inertia, memory):
    """omegadot = R J^-1 (R^T u - W x J W), W = R^T omega: Euler's equations under the torque u, base frame.

    In the form of a law, as `rk4_step` asks one: the torque stands for the goal, and the moments of inertia for gains.
    """
    W = rotate_back(R, omega)
    x, y, z = rotate_back(R, u)
    gx, gy, gz = cross(W, (inertia[0] * W[0], inertia[1] * W[1], inertia[2] * W[2]))
    return rotate(R, ((x - gx) / inertia[0], (y - gy) / inertia[1], (z - gz) / inertia[2])), memory, 0.0


@kernel
def uneven_step(R, omega, u, inertia, h):
    """Return the body one Runge-Kutta step on under a torque held in the base frame."""
    acceleration, memory, _ = uneven_acceleration(R, omega, u, inertia, 0.0)
    return rk4_step(uneven_acceleration, R, omega, acceleration, u, inertia, memory, h)


@kernel
def step(R, omega, u, inertia, h):
    """Return the body one step on under the torque u."""
    x, y, z = inertia
    if x < y or y < x or y < z or z < y:
        return uneven_step(R, omega, u, inertia, h)
    return held_step(R, omega, (u[0] / x, u[1] / x, u[2] / x), h)
