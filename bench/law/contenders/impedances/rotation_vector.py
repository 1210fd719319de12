"""Impedance on the rotation vector from the hand to the desired orientation: e = theta k, the spring of angle/axis.

Limitations: at 180° e jumps to -e.
"""

from bench.law import ADAPTED, Impedance, driven, kernel, relative, rotate
from bench.law.contenders.representations.rotation_vector import chart


@kernel
def law(R, omega, m, R_d, gains, inertia):
    """u = m/m_o + Kp theta k - Kv omega; theta k is that of R^T R_d, turned to the base frame."""
    e = rotate(R, chart(relative(R, R_d)).E)
    return driven(m, inertia, (gains.kp * e[0], gains.kp * e[1], gains.kp * e[2]), gains.kv, omega)


IMPEDANCE = Impedance(
    name="rotation-vector",
    title="Rotation vector to the goal",
    source="after Caccavale et al. 1999 (angle/axis; abstract read)",
    attribution=ADAPTED,
    formula=r"u = m/m_o + K_p\,\theta k - K_v\,\omega",
    law=law,
)
