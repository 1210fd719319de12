"""The paper's closed loops written out in numpy by hand from (2.6)-(2.16), calling no law and no engine of ours.

Many episodes at once: every array has one row per episode. A state is omega, n, o, a (Murphy 1988, 2.6-2.7), 12
numbers. Goals are given as a stack of matrices; the Euler laws read their angles off them.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

KP, KD = 100.0, 20.0  # Murphy 1988, 2.3


def euler_angles(n, o, a) -> np.ndarray:
    """alpha, beta, gamma by atan2 of elements of R (Craig 1986)."""
    return np.stack(
        [
            np.arctan2(n[:, 1], n[:, 0]),
            np.arctan2(-n[:, 2], np.hypot(n[:, 0], n[:, 1])),
            np.arctan2(o[:, 2], a[:, 2]),
        ],
        axis=1,
    )


def B(E) -> np.ndarray:
    """(2.8), one matrix an episode."""
    sa, ca, sb, cb = np.sin(E[:, 0]), np.cos(E[:, 0]), np.sin(E[:, 1]), np.cos(E[:, 1])
    zero, one = np.zeros_like(sa), np.ones_like(sa)
    return np.moveaxis(np.array([[zero, -sa, ca * cb], [zero, ca, sa * cb], [one, zero, -sb]]), 2, 0)


def B_rate(E, Edot) -> np.ndarray:
    """dB/dt, every element of (2.8) differentiated."""
    sa, ca, sb, cb = np.sin(E[:, 0]), np.cos(E[:, 0]), np.sin(E[:, 1]), np.cos(E[:, 1])
    ad, bd = Edot[:, 0], Edot[:, 1]
    zero = np.zeros_like(sa)
    return np.moveaxis(
        np.array(
            [
                [zero, -ca * ad, -sa * ad * cb - ca * sb * bd],
                [zero, -sa * ad, ca * ad * cb - sa * sb * bd],
                [zero, zero, -cb * bd],
            ]
        ),
        2,
        0,
    )


def rotation_matrix_command(omega, n, o, a, R_d) -> np.ndarray:
    """(2.12)-(2.13)."""
    e = (np.cross(n, R_d[:, :, 0]) + np.cross(o, R_d[:, :, 1]) + np.cross(a, R_d[:, :, 2])) / 2.0
    return KP * e - KD * omega


def _euler_command(omega, n, o, a, R_d):
    E, E_d = euler_angles(n, o, a), euler_angles(R_d[:, :, 0], R_d[:, :, 1], R_d[:, :, 2])
    Edot = np.linalg.solve(B(E), omega[:, :, None])[:, :, 0]
    return E, Edot, KP * (E_d - E) - KD * Edot


def linearized_euler_command(omega, n, o, a, R_d) -> np.ndarray:
    """PD on the model (2.14), whose matrix exchanges the first and the last."""
    return _euler_command(omega, n, o, a, R_d)[2][:, ::-1]


def feedback_linearized_command(omega, n, o, a, R_d) -> np.ndarray:
    """(2.15), u = B (u_E - d(B^-1)/dt omega), with d(B^-1)/dt = -B^-1 Bdot B^-1."""
    E, Edot, u_E = _euler_command(omega, n, o, a, R_d)
    return (B(E) @ u_E[:, :, None] + B_rate(E, Edot) @ Edot[:, :, None])[:, :, 0]


COMMANDS = {
    "rotation-matrix": rotation_matrix_command,
    "linearized-euler/zyx-euler": linearized_euler_command,
    "feedback-linearized/zyx-euler": feedback_linearized_command,
}


def paths(word, starts, times) -> np.ndarray:
    """omega, n, o, a of every start at the given times, (starts, times, 12), by DOP853 to 1e-12."""
    command = COMMANDS[word]
    R = Rotation.from_quat([start.quat_wxyz for start in starts], scalar_first=True).as_matrix()
    R_d = Rotation.from_quat([start.goal_wxyz for start in starts], scalar_first=True).as_matrix()
    first = np.concatenate([np.array([start.omega for start in starts]), *(R[:, :, j] for j in range(3))], axis=1)

    def rate(_, flat):
        omega, n, o, a = np.split(flat.reshape(len(starts), 12), 4, axis=1)
        turned = [np.cross(omega, column) for column in (n, o, a)]
        return np.concatenate([command(omega, n, o, a, R_d), *turned], axis=1).ravel()

    solution = solve_ivp(rate, (0.0, times[-1]), first.ravel(), method="DOP853", t_eval=times, rtol=1e-12, atol=1e-13)
    assert solution.success, solution.message
    return solution.y.reshape(len(starts), 12, len(times)).transpose(0, 2, 1)


def angles_to(R_d, states) -> np.ndarray:
    """Angle between R and the goal along paths (starts, times, 12), accurate at 0 and pi."""
    R = np.stack(np.split(states[:, :, 3:], 3, axis=2), axis=3)
    return (
        Rotation.from_matrix((R_d.transpose(0, 2, 1)[:, None] @ R).reshape(-1, 3, 3))
        .magnitude()
        .reshape(states.shape[:2])
    )
