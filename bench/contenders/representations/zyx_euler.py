"""Z-Y-X Euler angles E = (alpha, beta, gamma): R = Rz(alpha) Ry(beta) Rx(gamma) (Murphy 1988, 2.8-2.11).

Singular where cos(beta) = 0: at beta = +90 deg only alpha - gamma, at -90 deg only alpha + gamma is determined, and
B^-1 does not exist. alpha and gamma jump by 2 pi at +-pi.
"""

from bench.law import Look, Representation, Rotation, atan2, cos, kernel, sin, sqrt
from bench.law.euler import EulerChart, accelerate, angular_velocity, first_angle, generalized, rates


@kernel
def chart(R):
    """Angles of R; alpha, gamma in [-pi, pi], beta in [-pi/2, pi/2].

    gamma is measured in the frame already turned by alpha, so R is rebuilt to rounding however close the pole is,
    where alpha itself is lost.
    """
    cos_beta, alpha, sin_alpha, cos_alpha = first_angle(R.n[0], R.n[1])
    beta = atan2(-R.n[2], cos_beta)
    gamma = atan2(sin_alpha * R.a[0] - cos_alpha * R.a[1], cos_alpha * R.o[1] - sin_alpha * R.o[0])
    return EulerChart((alpha, beta, gamma), sin_alpha, cos_alpha, cos_beta, R.n[2])


@kernel
def chart_of(E):
    """The chart of given angles."""
    return EulerChart(E, sin(E[0]), cos(E[0]), cos(E[1]), -sin(E[1]))


@kernel
def to_matrix(E):
    """R = Rz(alpha) Ry(beta) Rx(gamma)."""
    sa, ca, sb, cb, sc, cc = sin(E[0]), cos(E[0]), sin(E[1]), cos(E[1]), sin(E[2]), cos(E[2])
    return Rotation(
        (ca * cb, sa * cb, -sb),
        (ca * sb * sc - sa * cc, sa * sb * sc + ca * cc, cb * sc),
        (ca * sb * cc + sa * sc, sa * sb * cc - ca * sc, cb * cc),
    )


@kernel
def margin(R):
    """cos(beta): 0 on the pole, 1 farthest from it."""
    return sqrt(R.n[0] * R.n[0] + R.n[1] * R.n[1])


@kernel
def slopes(R, Rdot):
    """Edot along Rdot, and 1/cos(beta) and its square."""
    inverse = 1.0 / sqrt(R.n[0] * R.n[0] + R.n[1] * R.n[1])
    inverse_square = inverse * inverse
    Edot = (
        (R.n[0] * Rdot.n[1] - R.n[1] * Rdot.n[0]) * inverse_square,
        -Rdot.n[2] * inverse,
        (R.a[2] * Rdot.o[2] - R.o[2] * Rdot.a[2]) * inverse_square,
    )
    return Edot, inverse, inverse_square


@kernel
def differentiate(R, Rdot):
    """Edot, with alpha = atan2(n_y, n_x), beta = -asin(n_z), gamma = atan2(o_z, a_z) differentiated (3.5).

    n stays a unit vector, so both pairs have the length cos(beta). Not finite on the pole.
    """
    return slopes(R, Rdot)[0]


@kernel
def differentiate_twice(R, Rdot, Rddot):
    """Eddot, the same differentiated again."""
    (alphadot, betadot, gammadot), inverse, inverse_square = slopes(R, Rdot)
    growth = -2.0 * R.n[2] * Rdot.n[2]  # of cos(beta)^2 = 1 - n_z^2
    return (
        (R.n[0] * Rddot.n[1] - R.n[1] * Rddot.n[0] - growth * alphadot) * inverse_square,
        -(Rddot.n[2] + R.n[2] * betadot * betadot) * inverse,
        (R.a[2] * Rddot.o[2] - R.o[2] * Rddot.a[2] - growth * gammadot) * inverse_square,
    )


REPRESENTATION = Representation(
    name="zyx-euler",
    title="Z-Y-X Euler angles",
    source="Murphy 1988, (2.8)-(2.11); Craig 1986",
    formula=r"R = R_z(\alpha)\, R_y(\beta)\, R_x(\gamma), \quad E = (\alpha, \beta, \gamma)",
    symbols=("alpha", "beta", "gamma"),
    chart=chart,
    chart_of=chart_of,
    to_matrix=to_matrix,
    rates=rates,
    accelerate=accelerate,
    angular_velocity=angular_velocity,
    generalized=generalized,
    margin=margin,
    about=(2, 1, 0),
    differentiate=differentiate,
    differentiate_twice=differentiate_twice,
    short="Z-Y-X angles",
    look=Look("vermillion", "s", "solid"),
    papers=True,
)
