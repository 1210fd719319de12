"""What Euler angles share, (alpha, beta, gamma): about an axis of the base, about y turned by that, and about a third.

Where the first axis is z, R = Rz(alpha) Ry(beta) R_3(gamma), the third is at

    w = (level cos alpha, level sin alpha, upright)         Z-Y-X: level = cos beta,  upright = -sin beta
                                                            Z-Y-Z: level = sin beta,  upright = cos beta

and B = [z, (-sin alpha, cos alpha, 0), w] (Murphy 1988, 2.8). X-Y-Z angles begin about x and keep their own B; their
level and upright are cos beta and sin beta. A chart measures gamma in the frame already turned by alpha, so that R is
rebuilt to rounding however close the pole is, where alpha itself is lost. Limitations: where level = 0 B^-1 does not
exist.
"""

from typing import NamedTuple

from bench.law.scalar import atan2, kernel, sqrt


class EulerChart(NamedTuple):
    """The angles, and what B needs of them: the first one's sine and cosine, and how the third axis leans."""

    E: tuple
    sin_alpha: float
    cos_alpha: float
    level: float
    upright: float


@kernel
def first_angle(x, y):
    """(level, alpha, sin alpha, cos alpha) of an axis at (level cos alpha, level sin alpha) = (x, y).

    On the pole, where level = 0, alpha := 0, and gamma carries the whole turn.
    """
    level = sqrt(x * x + y * y)
    if level > 0.0:
        return level, atan2(y, x), y / level, x / level
    return level, 0.0, 0.0, 1.0


@kernel
def rates(at, omega):
    """Edot = B^-1 omega (Murphy 1988, 2.9), written with its one division; not finite on the pole."""
    gammadot = (at.cos_alpha * omega[0] + at.sin_alpha * omega[1]) / at.level
    betadot = at.cos_alpha * omega[1] - at.sin_alpha * omega[0]
    return (omega[2] - at.upright * gammadot, betadot, gammadot)


@kernel
def accelerate(at, Edot, Eddot):
    """B Eddot + Bdot Edot, the angular acceleration that gives Eddot (Murphy 1988, 2.10 solved for u)."""
    alphadot, betadot, gammadot = Edot
    level = at.level * gammadot  # part of gammadot about the level axis (cos alpha, sin alpha, 0)
    along_y = Eddot[1] + alphadot * level
    along_x = Eddot[2] * at.level - betadot * (alphadot - at.upright * gammadot)
    return (
        at.cos_alpha * along_x - at.sin_alpha * along_y,
        at.cos_alpha * along_y + at.sin_alpha * along_x,
        Eddot[0] + at.upright * Eddot[2] - betadot * level,
    )


@kernel
def angular_velocity(at, Edot):
    """omega = B Edot (Murphy 1988, 2.8)."""
    along_x = at.level * Edot[2]
    return (
        at.cos_alpha * along_x - at.sin_alpha * Edot[1],
        at.cos_alpha * Edot[1] + at.sin_alpha * along_x,
        Edot[0] + at.upright * Edot[2],
    )


@kernel
def generalized(at, moment):
    """B^T m, the generalised forces of a moment (Murphy 1988, 3.12); exists at every orientation."""
    along_x = at.cos_alpha * moment[0] + at.sin_alpha * moment[1]
    return (
        moment[2],
        at.cos_alpha * moment[1] - at.sin_alpha * moment[0],
        at.level * along_x + at.upright * moment[2],
    )


def fields_of(elements):
    """Return the fields that angles share; derivatives are taken element by element (Murphy 1988, 3.5).

    elements(R) -> (x, y, z, X, Y): alpha = atan2(y, x), beta = asin(z) up to a constant, gamma = atan2(Y, X). A row and
    a column of R stay unit vectors, so that both pairs have the length level, and level^2 = 1 - z^2.
    """

    @kernel
    def slopes(R, Rdot):
        """Edot along Rdot, and 1/level and its square."""
        x, y, _, X, Y = elements(R)
        dx, dy, dz, dX, dY = elements(Rdot)
        inverse = 1.0 / sqrt(x * x + y * y)
        inverse_square = inverse * inverse
        Edot = ((x * dy - y * dx) * inverse_square, dz * inverse, (X * dY - Y * dX) * inverse_square)
        return Edot, inverse, inverse_square

    @kernel
    def differentiate(R, Rdot):
        """Edot; not finite on the pole."""
        return slopes(R, Rdot)[0]

    @kernel
    def differentiate_twice(R, Rdot, Rddot):
        """Eddot, the same differentiated again."""
        (alphadot, betadot, gammadot), inverse, inverse_square = slopes(R, Rdot)
        x, y, z, X, Y = elements(R)
        dz = elements(Rdot)[2]
        ddx, ddy, ddz, ddX, ddY = elements(Rddot)
        growth = -2.0 * z * dz  # of level^2
        return (
            (x * ddy - y * ddx - growth * alphadot) * inverse_square,
            (ddz + z * betadot * betadot) * inverse,
            (X * ddY - Y * ddX - growth * gammadot) * inverse_square,
        )

    symbols = ("alpha", "beta", "gamma")
    return {"symbols": symbols, "differentiate": differentiate, "differentiate_twice": differentiate_twice}


ABOUT_Z = {
    **{"rates": rates, "accelerate": accelerate, "angular_velocity": angular_velocity, "generalized": generalized},
    "about": (2, 1, 0),
}
"""The fields of angles whose first axis is z."""
