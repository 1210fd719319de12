"""An impedance's law called on arrays, and a free body under it: what the tests of impedances share."""

import numpy as np
from scipy.spatial.transform import Rotation as ScipyRotation

from bench.law.contender import bind
from support.bodies import path
from support.exact import exact_B
from support.in_contact import GAINS, IMPEDANCES, TOUCH
from support.states import of_scipy, vector

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
    return called(bind(one.impedance, one.representation), turn, omega, m, goal, gains)


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


def free_body(law, turn, omega, goal, seconds: float, moment, count: int):
    """(times, rotations, velocities, work) of a body under a law and a moment of time; work: its integral by omega."""
    times = np.linspace(0.0, seconds, count)

    def pushed(t, R, w, _):
        m = moment(t)
        return called(law, R, w, m, goal), [m @ w]

    turns, velocities, work = path(pushed, turn, omega, times, [0.0], rtol=1e-9, atol=1e-11)
    return times, turns, velocities, work[:, 0]
