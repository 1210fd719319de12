"""A free body under a command, by scipy's integrator: an oracle that knows no engine of ours."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation

from bench.law.inputs import Gains, Goal
from support.states import of_scipy, vector

REST = (0.0, 0.0, 0.0)


def path(acceleration, R, omega, times, more=(), method="DOP853", rtol=1e-11, atol=1e-13):
    """(rotations, angular velocities, more) at the times: R' = [omega]x R; omega', more' = acceleration(t, R, ...)."""

    def rate(t, y):
        v, w, omega = y[:3], y[3], y[4:7]
        u, others = acceleration(t, ScipyRotation.from_quat(y[:4]), omega, y[7:])
        return np.concatenate((0.5 * (w * omega + np.cross(omega, v)), [-0.5 * omega @ v], u, others))

    first = np.concatenate((R.as_quat(), omega, more))
    found = solve_ivp(rate, (0.0, times[-1]), first, method, times, rtol=rtol, atol=atol)
    assert found.success, found.message
    return ScipyRotation.from_quat(found.y[:4].T), found.y[4:7].T, found.y[7:].T


def commanded(one, R, omega, R_d, gains, state):
    """(u, state') of scipy rotations, as arrays."""
    u, rate = one.law.law(of_scipy(R), vector(omega), Goal(of_scipy(R_d)), Gains(*gains), tuple(map(np.float64, state)))
    return np.array(u), np.array(rate)


def motion(one, R, R_d, gains, times, omega=REST, disturbance=REST):
    """A body turned by a compensator: its path, and the compensator's states."""

    def pushed(_, R, omega, state):
        u, rate = commanded(one, R, omega, R_d, gains, state)
        return u + disturbance, rate

    return path(pushed, R, omega, times, one.begin(of_scipy(R)))


def regulated(law, start, times, **how):
    """A body under a law without memory, from a start of the judge's: rotations, velocities, angles to the goal."""
    R, R_d = (ScipyRotation.from_quat(quat, scalar_first=True) for quat in (start.quat_wxyz, start.goal_wxyz))
    goal, gains = Goal(of_scipy(R_d)), Gains()

    def turned(_, R, omega, __):
        return law(of_scipy(R), vector(omega), goal, gains), ()

    R, omega, _ = path(turned, R, start.omega, times, **how)
    return R, omega, np.linalg.norm(left(R, R_d), axis=1)


def left(R, R_d):
    """The rotation vectors from R to R_d, base frame."""
    return (R_d * R.inv()).as_rotvec()
