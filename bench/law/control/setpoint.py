"""What a controller in contact is given at a tick: a setpoint, its parameters, and the buffers it writes into."""

from typing import Any, NamedTuple

from bench.law.chain import Scratch


class ContactParameters(NamedTuple):
    """Constants of a controller in contact; the judge asks none of them, and all controllers share them.

    m_p [kg] and m_o [kg m^2]: apparent inertia. kc [1/s]: damping of what complies. The stiffness of an impedance is
    kp m_p and kp m_o. Along coordinates they are those of a coordinate: at E = 0 of mrp, where B = 4 I, a moment turns
    the hand 16 times as far as about axes. kf [1]: gain on the error of force, of the form `transpose` alone, which
    leaves the hand its own inertia over 1 + kf.
    """

    m_p: float = 20.0
    m_o: float = 0.5
    kc: float = 10.0
    kf: float = 0.5


TOUCH = ContactParameters()
"""Apparent inertias like those of the arms' hands at home (at most 18 kg and 0.64 kg m^2): a cancelled force comes a
tick late, and below half of those that tick would destabilize a contact. For the same reason kf is half of 1: against
something rigid F_k = -(h + kf (h + F_{k-1})), which converges for kf < 1."""


class Setpoint(NamedTuple):
    """What is wanted at one tick, base frame.

    R_d: orientation. p_d, v_d: place [m] and its velocity [m/s]. f_d, m_d: force [N] and moment [N m] to exert where
    the hand complies; along the axes that it carries along, if those are the controller's.
    """

    R_d: Any
    p_d: tuple
    v_d: tuple
    f_d: tuple
    m_d: tuple


class Rows(NamedTuple):
    """Five buffers of six numbers, along the axes or coordinates of a controller.

    a: commanded acceleration of what is held; drift: Jdot qdot; F: the wrench on the hand; h: the commanded
    wrench; v: its velocity.
    """

    a: Any
    drift: Any
    F: Any
    h: Any
    v: Any


class ContactBuffers(NamedTuple):
    """Buffers of `comply`: y, b and x (7), what is held of J (6 x 7), and the inverse's scratch (7 x 7)."""

    y: Any
    b: Any
    x: Any
    held: Any
    scratch: Scratch
