"""Six-axis impedance: the hand answers a wrench like a mass, a damper and a spring about its desired pose.

    m_p (pddot - vdot_d) + m_p Kv (pdot - v_d) + m_p Kp (p - p_d) = f + f_d
    omegadot = u(R, omega, m)

with the measured wrench cancelled by the joints (see `hybrid`) and put back by the law of an impedance, which is what
the files of bench/law/contenders/impedances differ in: what they take for the error of orientation, and along what the
moment acts.

Source: Hogan 1985; Caccavale, Natale, Siciliano, Villani 1999.
"""

from collections.abc import Callable

from bench.law.control.hybrid import hold_moving, measure, write
from bench.law.scalar import kernel


def assembly(law: Callable) -> Callable:
    """Return the rows of `hybrid.comply`, all of them held, for the law of an impedance."""

    @kernel
    def assemble(chain, setpoint, f, m, gains, touch, J, rows):
        """J, and a = (u_p, u) with the wrench put back, along the axes of the base frame."""
        pdot, omega = measure(chain, setpoint, f, m, J, rows)
        spring, f_d, m_d = hold_moving(chain.p, pdot, setpoint, gains), setpoint.f_d, setpoint.m_d
        pressed = (
            spring[0] + (f[0] + f_d[0]) / touch.m_p,
            spring[1] + (f[1] + f_d[1]) / touch.m_p,
            spring[2] + (f[2] + f_d[2]) / touch.m_p,
        )
        moment = (m[0] + m_d[0], m[1] + m_d[1], m[2] + m_d[2])
        write(rows.a, pressed, law(chain.R, omega, moment, setpoint.R_d, gains, touch.m_o))

    return assemble
