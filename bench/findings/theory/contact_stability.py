"""Whether a hand that presses on a spring settles: a mass of one freedom with force feedback, sampled and late.

    zdd = -kc zd + A (h + F + kf (h + F'))              by the Jacobian transpose, A = e^T J D^-1 J^T e
    zdd = -kc zd + (F' + h)/m_p + A (F - F')            by accelerations
    zdd = -kv zd - kp z + (F' + h)/m_p + A (F - F')     an impedance
    F = -(K z + B zd) - m_c zdd                         a contact, in touch; m_c as in tasks/contact_model.py

F' is F of the tick before, and as many ticks earlier as the sensor lags. What is held is cancelled but for what it adds
to F, so that along the normal this is all there is. Sampled as MuJoCo steps it, zd first, it is a linear map; it
settles if no eigenvalue of it is as long as 1.

In continuous time, with F' late by T, the transpose has s^2 + kc s + A (K + B s)(1 + kf exp(-s T)) = 0.

Limitations: says nothing of what leaves the surface and strikes again.
Source: Eppinger and Seering 1987, "Introduction to dynamic models for robot force control"; Murphy 1988, 3.3.
"""

from typing import NamedTuple

import numpy as np

from bench.law.control.contact_controller import PAPERS_FORM, ContactController
from bench.law.control.setpoint import TOUCH, ContactParameters
from bench.law.inputs import PAPERS_GAINS, Gains


class Spring(NamedTuple):
    """What is pressed on: stiffness [N/m], damping [N s/m], inertance m_c [kg]."""

    K: float
    B: float
    inertance: float = 0.0


def acceleration(
    controller: ContactController, mobility: float, gains: Gains = PAPERS_GAINS, touch: ContactParameters = TOUCH
) -> tuple[float, float, float, float]:
    """Return what zdd gets per z, zd, F and F' [1/s^2, 1/s, 1/kg, 1/kg]; mobility: A [1/kg]."""
    if controller.impedance is not None:
        return -gains.kp, -gains.kv, mobility, 1.0 / touch.m_p - mobility
    if controller.form == PAPERS_FORM:
        return 0.0, -touch.kc, mobility, touch.kf * mobility
    return 0.0, -touch.kc, mobility, 1.0 / touch.m_p - mobility


def step(law: tuple[float, float, float, float], spring: Spring, late: int, dt: float) -> np.ndarray:
    """Return the map of (z, zd, last late + 1 forces, latest first) over one tick; late: of the sensor, ticks."""
    along, damped, own, fed_back = law
    size = 3 + late
    free = np.zeros(size)  # zdd without the F of this step
    free[0], free[1], free[2 + late] = along, damped, fed_back
    stretched = np.zeros(size)
    stretched[:2] = spring.K, spring.B
    force = -(stretched + spring.inertance * free) / (1.0 + spring.inertance * own)
    made = np.zeros((size, size))
    made[1] = dt * (free + own * force)
    made[1, 1] += 1.0
    made[0] = dt * made[1]
    made[0, 0] += 1.0
    made[2] = force
    made[3:, 2:-1] = np.eye(late)
    return made


def settles(law: tuple[float, float, float, float], spring: Spring, late: int, dt: float) -> bool:
    """Whether the map shrinks; what is free of the spring is no part of it if nothing else holds z."""
    return bool(np.abs(np.linalg.eigvals(step(law, spring, late, dt))).max() < 1.0)
