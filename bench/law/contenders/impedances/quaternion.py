"""Impedance on the error quaternion of the shorter rotation: e = 2 sgn(eta) eps = 2 sin(theta/2) k.

Source: the error is Yuan 1988's. Its moment is the gradient of 4 k (1 - |eta|); Caccavale et al. 1999 take that of
2 eps^T K eps, which vanishes at 180° (`springs/quaternion_energy.py`).

Limitations: at 180° e jumps to -e; there the sign is that of `so3.quaternion_direction`.
"""

from bench.law import ADAPTED, Impedance, driven, kernel, quaternion_direction, relative, rotate, sqrt


@kernel
def law(R, omega, m, R_d, gains, inertia):
    """u = m/m_o + 2 Kp eps - Kv omega, (eta, eps) the unit quaternion of R^T R_d with eta >= 0, in the base frame."""
    (_, x, y, z), t = quaternion_direction(relative(R, R_d))
    scale = gains.kp / sqrt(t)
    e = rotate(R, (scale * x, scale * y, scale * z))
    return driven(m, inertia, e, gains.kv, omega)


IMPEDANCE = Impedance(
    name="quaternion",
    title="Quaternion to the goal",
    source="after Yuan 1988 (the error, on a mass and damper)",
    attribution=ADAPTED,
    formula=r"u = m/m_o + 2 K_p\,\operatorname{sgn}(\eta)\,\epsilon - K_v\,\omega",
    law=law,
)
