"""Modified Rodrigues parameters E = sigma = tan(theta/4) k, theta <= 180 deg, so that |sigma| <= 1: no trigonometry.

B is a rotation times 4/(1 + sigma^2), so B^-1 = (1 + sigma^2)^2/16 B^T; it is singular at 360 deg only, beyond
reach. Beyond a 180° rotation the shadow set -sigma/sigma^2 takes over: E jumps to -E there.
"""

from typing import NamedTuple

from bench.law import (
    LINEAR_MRP,
    PUBLISHED,
    Coordinates,
    Display,
    Look,
    cross,
    dot,
    from_quaternion,
    functions_of,
    kernel,
    quaternion_direction,
    sqrt,
)
from bench.law.contenders.representations.rotation_vector import combined


class Chart(NamedTuple):
    """sigma, and (1 - sigma^2)/2: the quaternion (w, x, y, z)/(1 + w), with its first element last."""

    E: tuple
    scalar: float


@kernel
def chart(R):
    """sigma of R; at 180° (|sigma| = 1) the element the extraction divides by is positive.

    With q the quaternion of any length |q|, sigma is (x, y, z)/(|q| + w): one division, by at least |q|.
    """
    (w, x, y, z), t = quaternion_direction(R)
    scale = 1.0 / (2.0 * sqrt(t) + w)
    return Chart((scale * x, scale * y, scale * z), scale * w)


@kernel
def chart_of(E):
    """Return the chart of given parameters."""
    return Chart(E, 0.5 - 0.5 * dot(E, E))


@kernel
def to_matrix(E):
    """R of the quaternion (1 - sigma^2, 2 sigma)/(1 + sigma^2)."""
    stretch = 2.0 / (1.0 + dot(E, E))
    return from_quaternion((stretch - 1.0, stretch * E[0], stretch * E[1], stretch * E[2]))


@kernel
def mapped(at, v, swept):
    """(1 - sigma^2)/2 v + swept + sigma (sigma . v), which is v turned by theta/2, times (1 + sigma^2)/2.

    Forward with swept = sigma x v, as B turns it; back with v x sigma, as B^-1 does.
    """
    return combined(at.scalar, v, swept, dot(at.E, v), at.E)


@kernel
def rates(at, omega):
    """Edot = B^-1 omega = 1/4 ((1 - sigma^2) omega - 2 sigma x omega + 2 sigma (sigma . omega)), base-frame omega."""
    double = mapped(at, omega, cross(omega, at.E))
    return (0.5 * double[0], 0.5 * double[1], 0.5 * double[2])


@kernel
def lifted(at, stretch, v, swept):
    """`mapped` times 8/(1 + sigma^2)^2, with stretch = 2/(1 + sigma^2): B v or B^T v by what is swept."""
    part, scale = mapped(at, v, swept), 2.0 * stretch * stretch
    return (scale * part[0], scale * part[1], scale * part[2])


@kernel
def angular_velocity(at, Edot):
    """omega = B Edot."""
    return lifted(at, 1.0 / (1.0 - at.scalar), Edot, cross(at.E, Edot))


@kernel
def accelerate(at, Edot, Eddot):
    """B Eddot + Bdot Edot = B (Eddot + 2/(1 + sigma^2) ((Edot . Edot) sigma - 2 (sigma . Edot) Edot)).

    Bdot Edot is B times the last part since B sigma = 4/(1 + sigma^2) sigma.
    """
    E, stretch = at.E, 1.0 / (1.0 - at.scalar)
    inward, against = stretch * dot(Edot, Edot), 2.0 * stretch * dot(E, Edot)
    straight = (
        Eddot[0] + inward * E[0] - against * Edot[0],
        Eddot[1] + inward * E[1] - against * Edot[1],
        Eddot[2] + inward * E[2] - against * Edot[2],
    )
    return lifted(at, stretch, straight, cross(E, straight))


@kernel
def generalized(at, moment):
    """B^T m, the generalised forces of a moment (Murphy 1988, 3.12)."""
    return lifted(at, 1.0 / (1.0 - at.scalar), moment, cross(moment, at.E))


@kernel
def margin(R):
    """1/(1 + sigma^2) = cos(theta/4)^2, the size of B by its size at the identity: from 1 to 1/2 at 180°."""
    q, t = quaternion_direction(R)
    return 0.5 + 0.25 * q[0] / sqrt(t)


REPRESENTATION = Coordinates(
    name="mrp",
    title="Modified Rodrigues parameters",
    source="Wiener 1962; also Tsiotras 1996; also Schaub & Junkins 2003",
    attribution=PUBLISHED,
    formula=r"E = \sigma = \tan\tfrac{\theta}{4}\, k, \quad |\sigma| \le 1",
    symbols=("sigma_x", "sigma_y", "sigma_z"),
    **functions_of(globals()),
    display=Display("MRP", Look("sky", "X", "dashed"), equation=LINEAR_MRP),
)
