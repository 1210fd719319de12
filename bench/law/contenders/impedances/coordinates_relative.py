"""Impedance in coordinates of R_d^T R, the orientation as seen from the goal: the singularity stays away from the goal.

Limitations: where B^-1 of the relative orientation does not exist; with Z-Y-X angles a quarter turn about y from the
goal.
"""

from bench.law import ADAPTED, IDENTITY, Impedance, kernel, relative, rotate, rotate_back
from bench.law.contenders.impedances import coordinates


def law_in(representation):
    """Return the law in the coordinates of one representation."""
    absolute = coordinates.law_in(representation)

    @kernel
    def law(R, omega, m, R_d, gains, inertia):
        """u = R_d u_r, with u_r the law `coordinates` of R_d^T R, R_d^T omega and R_d^T m towards the identity."""
        u_r = absolute(relative(R_d, R), rotate_back(R_d, omega), rotate_back(R_d, m), IDENTITY, gains, inertia)
        return rotate(R_d, u_r)

    return law


IMPEDANCE = Impedance(
    name="coordinates-relative",
    title="Coordinates seen from the goal",
    source="after Caccavale et al. 1999 (Euler angles of the relative orientation; abstract read)",
    attribution=ADAPTED,
    formula=r"u = R_d\,u_r(R_d^\top R,\ R_d^\top \omega,\ R_d^\top m)",
    law_in=law_in,
    relative=True,
)
