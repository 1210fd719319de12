"""A body turned by a compensator, by scipy: an oracle that knows no engine of ours."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation

from bench.law.inputs import Gains, Goal
from support.states import of_scipy, vector

REST = (0.0, 0.0, 0.0)


def commanded(one, R, omega, R_d, gains, state):
    """(u, state') of scipy rotations, as arrays."""
    u, rate = one.law(of_scipy(R), vector(omega), Goal(of_scipy(R_d)), Gains(*gains), tuple(map(np.float64, state)))
    return np.array(u), np.array(rate)


def motion(one, R, R_d, gains, times, omega=REST, disturbance=REST):
    """(rotations, angular velocities, states) at the times: R' = [omega]x R, omega' = u + d."""
    pushed = np.array(disturbance)

    def rate(_, y):
        u, after = commanded(one, ScipyRotation.from_quat(y[:4]), y[4:7], R_d, gains, y[7:])
        v, w = y[:3], y[3]
        return np.concatenate((0.5 * (w * y[4:7] + np.cross(y[4:7], v)), [-0.5 * y[4:7] @ v], u + pushed, after))

    first = np.concatenate((R.as_quat(), omega, one.state.begin(of_scipy(R))))
    found = solve_ivp(rate, (0.0, times[-1]), first, "DOP853", t_eval=times, rtol=1e-11, atol=1e-13)
    return ScipyRotation.from_quat(found.y[:4].T), found.y[4:7].T, found.y[7:].T


def left(R, R_d):
    """The rotation vectors from R to R_d, base frame."""
    return (R_d * R.inv()).as_rotvec()
