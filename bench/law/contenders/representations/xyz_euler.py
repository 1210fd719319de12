"""X-Y-Z Euler angles E = (alpha, beta, gamma): R = Rx(alpha) Ry(beta) Rz(gamma), each about the axis as turned so far.

Singular where cos(beta) = 0: at beta = +90 deg only alpha + gamma, at -90 deg only alpha - gamma is determined, and
B^-1 does not exist. alpha and gamma jump by 2 pi at +-pi.
"""

from bench.law import PUBLISHED, Coordinates, Display, Look, Rotation, atan2, cos, functions_of, kernel, sin, sqrt
from bench.law.euler import EulerChart, fields_of, first_angle


@kernel
def chart(R):
    """Angles of R; alpha, gamma in [-pi, pi], beta in [-pi/2, pi/2]."""
    cos_beta, alpha, sin_alpha, cos_alpha = first_angle(R.a[2], -R.a[1])
    beta = atan2(R.a[0], cos_beta)
    gamma = atan2(cos_alpha * R.n[1] + sin_alpha * R.n[2], cos_alpha * R.o[1] + sin_alpha * R.o[2])
    return EulerChart((alpha, beta, gamma), sin_alpha, cos_alpha, cos_beta, R.a[0])


@kernel
def chart_of(E):
    """Return the chart of given angles."""
    return EulerChart(E, sin(E[0]), cos(E[0]), cos(E[1]), sin(E[1]))


@kernel
def to_matrix(E):
    """R = Rx(alpha) Ry(beta) Rz(gamma)."""
    sa, ca, sb, cb, sc, cc = sin(E[0]), cos(E[0]), sin(E[1]), cos(E[1]), sin(E[2]), cos(E[2])
    return Rotation(
        (cb * cc, sa * sb * cc + ca * sc, sa * sc - ca * sb * cc),
        (-cb * sc, ca * cc - sa * sb * sc, ca * sb * sc + sa * cc),
        (sb, -sa * cb, ca * cb),
    )


@kernel
def rates(at, omega):
    """Edot = B^-1 omega, written with its one division; not finite on the pole."""
    gammadot = (at.cos_alpha * omega[2] - at.sin_alpha * omega[1]) / at.level
    betadot = at.cos_alpha * omega[1] + at.sin_alpha * omega[2]
    return (omega[0] - at.upright * gammadot, betadot, gammadot)


@kernel
def accelerate(at, Edot, Eddot):
    """B Eddot + Bdot Edot, the angular acceleration that gives Eddot."""
    alphadot, betadot, gammadot = Edot
    across = at.level * gammadot  # part of gammadot about the axis (0, -sin alpha, cos alpha)
    along_y = Eddot[1] - alphadot * across
    along_z = Eddot[2] * at.level + betadot * (alphadot - at.upright * gammadot)
    return (
        Eddot[0] + at.upright * Eddot[2] + betadot * across,
        at.cos_alpha * along_y - at.sin_alpha * along_z,
        at.cos_alpha * along_z + at.sin_alpha * along_y,
    )


@kernel
def angular_velocity(at, Edot):
    """omega = B Edot."""
    along_z = at.level * Edot[2]
    return (
        Edot[0] + at.upright * Edot[2],
        at.cos_alpha * Edot[1] - at.sin_alpha * along_z,
        at.cos_alpha * along_z + at.sin_alpha * Edot[1],
    )


@kernel
def generalized(at, moment):
    """B^T m, the generalised forces of a moment (Murphy 1988, 3.12); exists at every orientation."""
    along_z = at.cos_alpha * moment[2] - at.sin_alpha * moment[1]
    return (
        moment[0],
        at.cos_alpha * moment[1] + at.sin_alpha * moment[2],
        at.upright * moment[0] + at.level * along_z,
    )


@kernel
def margin(R):
    """cos(beta): 0 on the pole, 1 farthest from it."""
    return sqrt(R.a[1] * R.a[1] + R.a[2] * R.a[2])


@kernel
def elements(R):
    """Return what gives the angles: alpha = atan2(-a_y, a_z), beta = asin(a_x), gamma = atan2(-o_x, n_x)."""
    return (R.a[2], -R.a[1], R.a[0], R.n[0], -R.o[0])


REPRESENTATION = Coordinates(
    name="xyz-euler",
    title="X-Y-Z Euler angles",
    source="Craig 1986",
    attribution=PUBLISHED,
    formula=r"R = R_x(\alpha)\, R_y(\beta)\, R_z(\gamma), \quad E = (\alpha, \beta, \gamma)",
    **functions_of(globals()),
    **fields_of(elements),
    display=Display("X-Y-Z angles", Look("orange", "v", "dashed")),
)
