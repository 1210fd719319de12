"""Z-Y-X Euler angles E = (alpha, beta, gamma): R = Rz(alpha) Ry(beta) Rx(gamma) (Murphy 1988, 2.8-2.11).

Singular where cos(beta) = 0: at beta = +90 deg only alpha - gamma, at -90 deg only alpha + gamma is determined, and
B^-1 does not exist. alpha and gamma jump by 2 pi at +-pi.
"""

from bench.law import PUBLISHED, Coordinates, Display, Look, Rotation, atan2, cos, functions_of, kernel, sin, sqrt
from bench.law.euler import ABOUT_Z, EulerChart, fields_of, first_angle


@kernel
def chart(R):
    """Angles of R; alpha, gamma in [-pi, pi], beta in [-pi/2, pi/2]."""
    cos_beta, alpha, sin_alpha, cos_alpha = first_angle(R.n[0], R.n[1])
    beta = atan2(-R.n[2], cos_beta)
    gamma = atan2(sin_alpha * R.a[0] - cos_alpha * R.a[1], cos_alpha * R.o[1] - sin_alpha * R.o[0])
    return EulerChart((alpha, beta, gamma), sin_alpha, cos_alpha, cos_beta, R.n[2])


@kernel
def chart_of(E):
    """Return the chart of given angles."""
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
def elements(R):
    """Return what gives the angles: alpha = atan2(n_y, n_x), beta = asin(-n_z), gamma = atan2(o_z, a_z)."""
    return (R.n[0], R.n[1], -R.n[2], R.a[2], R.o[2])


REPRESENTATION = Coordinates(
    name="zyx-euler",
    title="Z-Y-X Euler angles",
    source="Murphy 1988, (2.8)-(2.11); also Craig 1986",
    attribution=PUBLISHED,
    formula=r"R = R_z(\alpha)\, R_y(\beta)\, R_x(\gamma), \quad E = (\alpha, \beta, \gamma)",
    **functions_of(globals()),
    **ABOUT_Z,
    **fields_of(elements),
    is_in_paper=True,
    display=Display("Z-Y-X angles", Look("vermillion", "s", "solid")),
)
