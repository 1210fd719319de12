"""Impedance in coordinates of the base frame: a mass, damper and spring in each of them.

    m_o (Eddot + Kv Edot + Kp (E - E_d)) = B^T m

What B^T takes of a moment (Murphy 1988, 3.12) and B gives back as motion need not lie along it: at rest the hand has
turned by B B^T m / (kp m_o), so that its stiffness is kp m_o B^-T B^-1. With Z-Y-X angles the condition number of that
is (1 + |sin beta|)/(1 - |sin beta|).

Limitations: where B^-1 does not exist; a moment is lost there.
"""

from bench.law import ADAPTED, Impedance, driven, kernel


def law_in(representation):
    """Return the law in the coordinates of one representation."""
    chart, rates, accelerate = representation.chart, representation.rates, representation.accelerate
    generalized = representation.generalized

    @kernel
    def law(R, omega, m, R_d, gains, inertia):
        """u = B (B^T m/m_o + Kp (E_d - E) - Kv Edot) + Bdot Edot."""
        at = chart(R)
        E, E_d, Edot, g = at.E, chart(R_d).E, rates(at, omega), generalized(at, m)
        spring = (gains.kp * (E_d[0] - E[0]), gains.kp * (E_d[1] - E[1]), gains.kp * (E_d[2] - E[2]))
        return accelerate(at, Edot, driven(g, inertia, spring, gains.kv, Edot))

    return law


IMPEDANCE = Impedance(
    name="coordinates",
    title="Coordinates of the base frame",
    source=(
        "after Hogan 1985, Caccavale et al. 1999 (Euler angles; abstract read) and Murphy "
        "1988, (3.7), (3.12)"
    ),
    attribution=ADAPTED,
    formula=r"u = B \bigl(B^\top m/m_o + K_p (E_d - E) - K_v \dot E\bigr) + \dot B \dot E",
    law_in=law_in,
)
