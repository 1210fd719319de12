"""Impedance on the error of the rotation-matrix regulator: e = sin(theta) k.

Limitations: at 180° rotations from the goal the spring gives way to nothing.
"""

from bench.law import ADAPTED, AT_REST, Goal, Impedance, kernel
from bench.law.contenders.regulators.rotation_matrix import law as regulate


@kernel
def law(R, omega, m, R_d, gains, inertia):
    """u = m/m_o + Kp (n x n_d + o x o_d + a x a_d)/2 - Kv omega."""
    u = regulate(R, omega, Goal(R_d, AT_REST, AT_REST), gains)
    return (u[0] + m[0] / inertia, u[1] + m[1] / inertia, u[2] + m[2] / inertia)


IMPEDANCE = Impedance(
    name="geometric",
    title="Columns of R",
    source="after Luh, Walker, Paul 1980 (the error) and Caccavale et al. 1999 (abstract read)",
    attribution=ADAPTED,
    formula=r"u = m/m_o + \tfrac{1}{2} K_p\,(n \times n_d + o \times o_d + a \times a_d) - K_v\,\omega",
    law=law,
)
"""Its stiffness is kp m_o I at the goal, and cos(theta) of that along theta k."""
