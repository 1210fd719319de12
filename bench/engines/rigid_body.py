"""A rigid body whose inertia is not the controller's model of it, moved by a torque that is held."""

from bench.engines.ideal import held_step, moved, plus, rotation_rate, weighted
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, cross, rotate, rotate_back


@kernel
def uneven_acceleration(R, omega, u, inertia):
    """omegadot = R J^-1 (R^T u - W x J W), W = R^T omega: Euler's equations under the torque u, base frame."""
    W = rotate_back(R, omega)
    x, y, z = rotate_back(R, u)
    gx, gy, gz = cross(W, (inertia[0] * W[0], inertia[1] * W[1], inertia[2] * W[2]))
    return rotate(R, ((x - gx) / inertia[0], (y - gy) / inertia[1], (z - gz) / inertia[2]))


@kernel
def uneven_step(R, omega, u, inertia, h):
    """Return the body one Runge-Kutta step on under a torque held in the base frame."""
    half = 0.5 * h
    a1, R1 = uneven_acceleration(R, omega, u, inertia), rotation_rate(R, omega)
    omega2, at2 = plus(omega, half, a1), moved(R, half, R1)
    a2, R2 = uneven_acceleration(at2, omega2, u, inertia), rotation_rate(at2, omega2)
    omega3, at3 = plus(omega, half, a2), moved(R, half, R2)
    a3, R3 = uneven_acceleration(at3, omega3, u, inertia), rotation_rate(at3, omega3)
    omega4, at4 = plus(omega, h, a3), moved(R, h, R3)
    a4, R4 = uneven_acceleration(at4, omega4, u, inertia), rotation_rate(at4, omega4)
    n = weighted(R1.n, R2.n, R3.n, R4.n)
    o = weighted(R1.o, R2.o, R3.o, R4.o)
    a = weighted(R1.a, R2.a, R3.a, R4.a)
    return moved(R, h / 6.0, Rotation(n, o, a)), plus(omega, h / 6.0, weighted(a1, a2, a3, a4))


@kernel
def step(R, omega, u, inertia, h):
    """Return the body one step on under the torque u."""
    x, y, z = inertia
    if x < y or y < x or y < z or z < y:
        return uneven_step(R, omega, u, inertia, h)
    return held_step(R, omega, (u[0] / x, u[1] / x, u[2] / x), h)
