"""The rotation vector E = phi = theta k: axis times angle, |phi| <= pi.

B = J_l(phi), the left Jacobian, is singular at |phi| = 2 pi only, beyond reach. At 180° E jumps to -E.
"""

from typing import NamedTuple

from bench.law import (
    ANGLE,
    PUBLISHED,
    Coordinates,
    Display,
    Look,
    atan2,
    cos,
    cross,
    dot,
    from_quaternion,
    functions_of,
    kernel,
    quaternion_direction,
    sin,
    sqrt,
)

FLAT = 1e-7
"""rad^2. Below, (1 - (theta/2) cot(theta/2))/theta^2 is 1/12: the theta^2/720 dropped, times theta^2 for the two
factors phi it meets, is under 1.4e-17. Above, the closed form may be off by EPS/theta^2, which they make EPS again."""

NEAR = 0.25
"""rad^2. Below, (theta - sin theta)/theta^3 and two derivatives are series of six terms: the first one dropped,
theta^12/15!, times theta for the one factor phi it meets, is under 1e-16. Above, the closed forms are off by
EPS/theta^2, which that factor makes EPS/theta: 2 EPS at worst."""


class Chart(NamedTuple):
    """phi; theta^2; (theta/2) cot(theta/2); theta^2/(1 - cos theta)."""

    E: tuple
    square: float
    half_cot: float
    spread: float


@kernel
def chart(R):
    """phi of R; at 180° (|phi| = pi) the element of the axis the extraction divides by is positive.

    With q the quaternion of any length, theta = 2 atan2(|(x, y, z)|, w), accurate at both ends of its range; its
    cosines and sines are elements of q, so that no other function is needed. Where the vector's square is 0 (below
    1e-162 rad it underflows), phi = 2 (x, y, z)/w.
    """
    (w, x, y, z), t = quaternion_direction(R)
    square = x * x + y * y + z * z
    if square > 0.0:
        size = sqrt(square)
        stretch = 2.0 * atan2(size, w) / size
    else:
        stretch = 2.0 / w
    stretch_square = stretch * stretch
    return Chart(
        (stretch * x, stretch * y, stretch * z),
        stretch_square * square,
        0.5 * stretch * w,
        2.0 * stretch_square * t,
    )


@kernel
def chart_of(E):
    """Return the chart of a given vector."""
    square = dot(E, E)
    if square > 0.0:
        half = 0.5 * sqrt(square)
        sine = sin(half)
        return Chart(E, square, half * cos(half) / sine, 0.5 * square / (sine * sine))
    return Chart(E, square, 1.0, 2.0)


@kernel
def to_matrix(E):
    """R of the quaternion (cos(theta/2), sin(theta/2)/theta phi)."""
    square = dot(E, E)
    if square > 0.0:
        angle = sqrt(square)
        w, scale = cos(0.5 * angle), sin(0.5 * angle) / angle
    else:
        w, scale = 1.0, 0.5
    return from_quaternion((w, scale * E[0], scale * E[1], scale * E[2]))


@kernel
def rates(at, omega):
    """Edot = J_l^-1 omega = g omega - 1/2 phi x omega + (1 - g)/theta^2 phi (phi . omega), g = half_cot."""
    phi, g = at.E, at.half_cot
    bend = (1.0 - g) / at.square if at.square > FLAT else 1.0 / 12.0
    along, swept = bend * dot(phi, omega), cross(phi, omega)
    return (
        g * omega[0] - 0.5 * swept[0] + along * phi[0],
        g * omega[1] - 0.5 * swept[1] + along * phi[1],
        g * omega[2] - 0.5 * swept[2] + along * phi[2],
    )


@kernel
def coefficients(at):
    """s, a, b of J_l v = s v + a phi x v + b phi (phi . v).

    s = sin theta/theta, a = (1 - cos theta)/theta^2, b = (theta - sin theta)/theta^3.
    """
    a, x = 1.0 / at.spread, at.square
    s = 2.0 * a * at.half_cot
    if x > NEAR:
        b = (1.0 - s) / x
    else:
        b = 1.0 / 6.0 - x * (
            1.0 / 120.0 - x * (1.0 / 5040.0 - x * (1.0 / 362880.0 - x * (1.0 / 39916800.0 - x * (1.0 / 6227020800.0))))
        )
    return s, a, b


@kernel
def slopes(at, s, a, b):
    """Return a' and b', where the time derivatives are a' (phi . phidot) and b' (phi . phidot); that of s is b - a."""
    x = at.square
    if x > NEAR:
        inverse = 1.0 / x
        return (s - 2.0 * a) * inverse, (a - 3.0 * b) * inverse
    return (
        x
        * (1.0 / 180.0 - x * (1.0 / 6720.0 - x * (1.0 / 453600.0 - x * (1.0 / 47900160.0 - x * (1.0 / 7264857600.0)))))
        - 1.0 / 12.0,
        x
        * (
            1.0 / 1260.0
            - x * (1.0 / 60480.0 - x * (1.0 / 4989600.0 - x * (1.0 / 622702080.0 - x * (1.0 / 108972864000.0))))
        )
        - 1.0 / 60.0,
    )


@kernel
def combined(s, v, swept, along, phi):
    """s v + swept + along phi."""
    return (
        s * v[0] + swept[0] + along * phi[0],
        s * v[1] + swept[1] + along * phi[1],
        s * v[2] + swept[2] + along * phi[2],
    )


@kernel
def angular_velocity(at, Edot):
    """omega = J_l phidot."""
    s, a, b = coefficients(at)
    phi = at.E
    swept = cross((a * phi[0], a * phi[1], a * phi[2]), Edot)
    return combined(s, Edot, swept, b * dot(phi, Edot), phi)


@kernel
def accelerate(at, Edot, Eddot):
    """J_l phiddot + Jdot_l phidot.

    Jdot_l phidot = (2 b - a) p phidot + a' p phi x phidot + (b phidot . phidot + b' p^2) phi, p = phi . phidot.
    """
    s, a, b = coefficients(at)
    da, db = slopes(at, s, a, b)
    phi, p = at.E, dot(at.E, Edot)
    da_p, lag = da * p, (b + b - a) * p
    turned = (
        a * Eddot[0] + da_p * Edot[0],
        a * Eddot[1] + da_p * Edot[1],
        a * Eddot[2] + da_p * Edot[2],
    )
    swept = cross(phi, turned)
    along = b * (dot(phi, Eddot) + dot(Edot, Edot)) + db * p * p
    return (
        s * Eddot[0] + lag * Edot[0] + swept[0] + along * phi[0],
        s * Eddot[1] + lag * Edot[1] + swept[1] + along * phi[1],
        s * Eddot[2] + lag * Edot[2] + swept[2] + along * phi[2],
    )


@kernel
def generalized(at, moment):
    """J_l^T m, the generalised forces of a moment (Murphy 1988, 3.12)."""
    s, a, b = coefficients(at)
    phi = at.E
    swept = cross(moment, (a * phi[0], a * phi[1], a * phi[2]))
    return combined(s, moment, swept, b * dot(phi, moment), phi)


@kernel
def margin(R):
    """sin(theta/2)/(theta/2), the least singular value of J_l: 1 at the identity, 2/pi at 180°."""
    (w, x, y, z), t = quaternion_direction(R)
    square = x * x + y * y + z * z
    if square > 0.0:
        size = sqrt(square)
        return 0.5 * size / (sqrt(t) * atan2(size, w))
    return 1.0


REPRESENTATION = Coordinates(
    name="rotation-vector",
    title="Rotation vector",
    source="Bullo & Murray 1995; also Caccavale, Siciliano, Villani 1999",
    attribution=PUBLISHED,
    formula=r"E = \phi = \theta\, k, \quad |\phi| \le \pi, \quad \omega = J_l(\phi)\, \dot\phi",
    symbols=("phi_x", "phi_y", "phi_z"),
    **functions_of(globals()),
    display=Display("rotation vectors", Look("purple", "D", "dotted"), equation=ANGLE),
)
