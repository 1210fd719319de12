"""Six-axis impedance: the hand answers a wrench like a mass, a damper and a spring about where it shall be.

    m_p (pddot - vdot_d) + m_p Kv (pdot - v_d) + m_p Kp (p - p_d) = f + f_d
    omegadot = u(R, omega, m)

with the measured wrench cancelled by the joints (see `force`) and put back by the law of an impedance, which is what
the files of bench/impedances differ in: what they take for the error of orientation, and along what the moment acts.

Source: Hogan 1985; Caccavale, Natale, Siciliano, Villani 1999.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.chain import bias_acceleration, twist
from bench.contender import Representation
from bench.force import hold_moving, write
from bench.jacobians.geometric import fill
from bench.scalar import kernel


class Impedance(NamedTuple):
    """A law u = law(R, omega, m, R_d, gains, inertia): the hand's angular acceleration in the base frame [rad/s^2].

    m: the moment on the hand and what it shall exert besides [N m], base frame. inertia: apparent, [kg m^2]. Near the
    goal the stiffness is kp inertia [N m/rad]; of an impedance in coordinates it is that times B^-T B^-1.
    law_in(representation) -> law, of an impedance in coordinates; `law` is then None.
    relative: the coordinates are those of R_d^T R.
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable | None = None
    law_in: Callable | None = None
    relative: bool = False


def assembly(law: Callable) -> Callable:
    """The rows of `force.comply`, all of them held, for the law of an impedance."""

    @kernel
    def assemble(chain, wish, f, m, gains, touch, J, rows):
        """J, and a = (u_p, u) with the wrench put back, along the axes of the base frame."""
        pdot, omega = twist(chain)
        bias = bias_acceleration(chain)
        fill(J, chain)
        spring, f_d, m_d = hold_moving(chain.p, pdot, wish, gains), wish.f_d, wish.m_d
        pressed = (
            spring[0] + (f[0] + f_d[0]) / touch.m_p,
            spring[1] + (f[1] + f_d[1]) / touch.m_p,
            spring[2] + (f[2] + f_d[2]) / touch.m_p,
        )
        moment = (m[0] + m_d[0], m[1] + m_d[1], m[2] + m_d[2])
        write(rows.a, pressed, law(chain.R, omega, moment, wish.R_d, gains, touch.m_o))
        write(rows.drift, (bias[0], bias[1], bias[2]), (bias[3], bias[4], bias[5]))
        write(rows.F, f, m)
        write(rows.h, f_d, m_d)
        write(rows.v, pdot, omega)

    return assemble


def law_of(impedance: Impedance, representation: Representation | None) -> Callable:
    """The law, in a representation if it is one in coordinates."""
    if impedance.law_in is not None and representation is not None:
        return impedance.law_in(representation)
    assert impedance.law is not None
    return impedance.law
