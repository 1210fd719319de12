"""Z-Y-Z Euler angles E = (alpha, beta, gamma): R = Rz(alpha) Ry(beta) Rz(gamma) (Murphy 1988, 2.2).

Singular where sin(beta) = 0, the identity included: at beta = 0 only alpha + gamma, at 180 deg only alpha - gamma is
determined, and B^-1 does not exist. alpha and gamma jump by 2 pi at +-pi.
"""

from bench.law import PUBLISHED, Coordinates, Display, Look, Rotation, atan2, cos, functions_of, kernel, sin, sqrt
from bench.law.euler import ABOUT_Z, EulerChart, fields_of, first_angle


@kernel
def chart(R):
    """Angles of R; alpha, gamma in [-pi, pi], beta in [0, pi]."""
    sin_beta, alpha, sin_alpha, cos_alpha = first_angle(R.a[0], R.a[1])
    beta = atan2(sin_beta, R.a[2])
    gamma = atan2(cos_alpha * R.n[1] - sin_alpha * R.n[0], cos_alpha * R.o[1] - sin_alpha * R.o[0])
    return EulerChart((alpha, beta, gamma), sin_alpha, cos_alpha, sin_beta, R.a[2])


@kernel
def chart_of(E):
    """Return the chart of given angles."""
    return EulerChart(E, sin(E[0]), cos(E[0]), sin(E[1]), cos(E[1]))


@kernel
def to_matrix(E):
    """R = Rz(alpha) Ry(beta) Rz(gamma)."""
    sa, ca, sb, cb, sc, cc = sin(E[0]), cos(E[0]), sin(E[1]), cos(E[1]), sin(E[2]), cos(E[2])
    return Rotation(
        (ca * cb * cc - sa * sc, sa * cb * cc + ca * sc, -sb * cc),
        (-ca * cb * sc - sa * cc, ca * cc - sa * cb * sc, sb * sc),
        (ca * sb, sa * sb, cb),
    )


@kernel
def margin(R):
    """sin(beta): 0 on the pole, 1 farthest from it."""
    return sqrt(R.a[0] * R.a[0] + R.a[1] * R.a[1])


@kernel
def elements(R):
    """Return what gives the angles: alpha = atan2(a_y, a_x), beta = asin(-a_z) + pi/2, gamma = atan2(o_z, -n_z)."""
    return (R.a[0], R.a[1], -R.a[2], -R.n[2], R.o[2])


REPRESENTATION = Coordinates(
    name="zyz-euler",
    title="Z-Y-Z Euler angles",
    source="Murphy 1988, 2.2; also Craig 1986",
    attribution=PUBLISHED,
    formula=r"R = R_z(\alpha)\, R_y(\beta)\, R_z(\gamma), \quad E = (\alpha, \beta, \gamma)",
    **functions_of(globals()),
    **ABOUT_Z,
    **fields_of(elements),
    display=Display("Z-Y-Z angles", Look("green", "^", "dash-dot")),
)
