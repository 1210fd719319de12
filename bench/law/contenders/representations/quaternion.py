"""The unit quaternion E = (w, x, y, z), w >= 0: the rotation by 2 acos(w) about (x, y, z).

Four coordinates of a rotation: B is 3 x 4, and for Edot = B^-1 omega stands Edot = (1/2) Xi omega, tangent to the unit
sphere. An Edot or Eddot along E itself moves nothing. Never singular. Of the two quaternions of R the extraction takes
the one with w >= 0: E jumps to -E at 180° rotations.
"""

from typing import NamedTuple

from bench.law import (
    CHORD,
    PUBLISHED,
    Coordinates,
    Display,
    Look,
    from_quaternion,
    functions_of,
    kernel,
    quaternion_direction,
    sqrt,
)


class Chart(NamedTuple):
    """The quaternion; B needs nothing else."""

    E: tuple


@kernel
def chart(R):
    """Return unit quaternion of R with w >= 0; at 180° (w = 0) the element the extraction divides by is positive."""
    (w, x, y, z), t = quaternion_direction(R)
    scale = 0.5 / sqrt(t)
    return Chart((scale * w, scale * x, scale * y, scale * z))


@kernel
def chart_of(E):
    """Return the chart of a given unit quaternion."""
    return Chart(E)


@kernel
def spread(E, v):
    """(0, v) E, the quaternion product: Xi v, perpendicular to E."""
    w, x, y, z = E
    return (
        -(x * v[0] + y * v[1] + z * v[2]),
        w * v[0] + v[1] * z - v[2] * y,
        w * v[1] + v[2] * x - v[0] * z,
        w * v[2] + v[0] * y - v[1] * x,
    )


@kernel
def gather(E, V):
    """Xi^T V, the vector part of V E*: of a V along E nothing is left."""
    w, x, y, z = E
    return (
        w * V[1] - x * V[0] + y * V[3] - z * V[2],
        w * V[2] - y * V[0] + z * V[1] - x * V[3],
        w * V[3] - z * V[0] + x * V[2] - y * V[1],
    )


@kernel
def rates(at, omega):
    """Edot = (1/2) Xi omega, omega in the base frame."""
    return spread(at.E, (0.5 * omega[0], 0.5 * omega[1], 0.5 * omega[2]))


@kernel
def angular_velocity(at, Edot):
    """omega = B Edot = 2 Xi^T Edot."""
    half = gather(at.E, Edot)
    return (2.0 * half[0], 2.0 * half[1], 2.0 * half[2])


@kernel
def accelerate(at, Edot, Eddot):
    """B Eddot = 2 Xi^T Eddot. Bdot Edot vanishes: it is twice the vector part of Edot Edot*, a real number."""
    return angular_velocity(at, Eddot)


@kernel
def generalized(at, moment):
    """B^T m = 2 Xi m, four generalised forces (Murphy 1988, 3.12); none of them is along E."""
    return spread(at.E, (2.0 * moment[0], 2.0 * moment[1], 2.0 * moment[2]))


@kernel
def margin(R):
    """1: the singular values of B are 2, 2, 2 everywhere."""
    return 1.0


REPRESENTATION = Coordinates(
    name="quaternion",
    title="Unit quaternion",
    source="Shepperd 1978; also Wie, Weiss, Arapostathis 1989",
    attribution=PUBLISHED,
    formula=r"E = (\cos\tfrac{\theta}{2},\; \sin\tfrac{\theta}{2}\, k), \quad \dot E = \tfrac12\, (0, \omega)\, E",
    symbols=("w", "x", "y", "z"),
    **functions_of(globals()),
    to_matrix=from_quaternion,
    about=None,
    display=Display("quaternions", Look("blue", "o", "solid"), equation=CHORD),
)
