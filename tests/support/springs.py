"""An impedance's or a compensator's law called on arrays, and a free body under it, by scipy: an oracle of its own."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation

from bench.law.control.impedance import law_of
from bench.law.inputs import Gains, Goal
from support.exact import exact_B
from support.in_contact import GAINS, IMPEDANCES, TOUCH
from support.states import as_rotation, of_scipy, vector

STILL = np.zeros(3)


def of(word: str):
    """The impedance controller of that name."""
    [one] = [one for one in IMPEDANCES if one.name == f"impedance-{word}"]
    return one


def called(law, turn, omega, m, goal, gains=GAINS) -> np.ndarray:
    """u of a law, of scipy's rotations and arrays."""
    with np.errstate(all="ignore"):
        return np.array(law(of_scipy(turn), vector(omega), vector(m), of_scipy(goal), gains, np.float64(TOUCH.m_o)))


def command(one, turn, omega, m, goal, gains=GAINS) -> np.ndarray:
    """u of a controller's law."""
    return called(law_of(one.impedance, one.representation), turn, omega, m, goal, gains)


def seen(one, turn: ScipyRotation, goal: ScipyRotation) -> ScipyRotation:
    """The orientation that its coordinates are of."""
    return goal.inv() * turn if one.impedance.relative else turn


def margin(one, turn: ScipyRotation, goal: ScipyRotation) -> float:
    """Return the margin of its coordinates there, or 1 if it has none."""
    return 1.0 if one.representation is None else one.representation.margin(of_scipy(seen(one, turn, goal)))


def B_at(one, turn: ScipyRotation, goal: ScipyRotation) -> np.ndarray:
    """B of omega = B Edot, base frame, by 80 digits; the identity without coordinates."""
    if one.representation is None:
        return np.eye(3)
    E = one.representation.chart(of_scipy(seen(one, turn, goal))).E
    B = np.array(exact_B(one.representation.to_matrix, E).tolist(), dtype=float)
    return goal.as_matrix() @ B if one.impedance.relative else B


def free_body(law, turn, omega, goal, seconds: float, moment=lambda t: STILL, count: int = 200):
    """(times, R, omega, work) of Rdot = [omega]x R, omegadot = u; work: integral of moment . omega, by scipy."""

    def slope(t, y):
        R, w, m = y[:9].reshape(3, 3), y[9:12], moment(t)
        with np.errstate(all="ignore"):
            u = law(as_rotation(R.T), vector(w), vector(m), of_scipy(goal), GAINS, np.float64(TOUCH.m_o))
        spin = np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
        return np.concatenate(((spin @ R).ravel(), u, [m @ w]))

    first = np.concatenate((turn.as_matrix().ravel(), omega, [0.0]))
    times = np.linspace(0.0, seconds, count)
    found = solve_ivp(slope, (0.0, seconds), first, method="DOP853", t_eval=times, rtol=1e-9, atol=1e-11)
    assert found.success, found.message
    return times, found.y[:9].T.reshape(-1, 3, 3), found.y[9:12].T, found.y[12]


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
