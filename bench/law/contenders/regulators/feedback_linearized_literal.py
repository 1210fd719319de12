"""(2.15) as the paper writes it, with B, its inverse and the inverse's derivative as matrices: a second costing.

The same command as feedback-linearized to rounding; listed so that its price can be compared.
Limitations: as feedback-linearized does.
"""

from bench.law import COSTING, PUBLISHED, Display, Law, Look, OnCoordinates, cos, kernel, sin


@kernel
def inverse_times(sa, ca, sb, cb, omega):
    """B^-1 omega with the elements of (2.9); its two constant rows are not multiplied out."""
    return (
        ca * sb / cb * omega[0] + sa * sb / cb * omega[1] + omega[2],
        -sa * omega[0] + ca * omega[1],
        ca / cb * omega[0] + sa / cb * omega[1],
    )


@kernel
def inverse_rate_times(sa, ca, sb, cb, Edot, omega):
    """d(B^-1)/dt omega, each element of (2.9) differentiated."""
    alphadot, betadot = Edot[0], Edot[1]
    cb2 = cb * cb
    tan_rate = betadot / cb2
    secant_rate = sb * betadot / cb2
    tangent = sb / cb
    return (
        (-sa * alphadot * tangent + ca * tan_rate) * omega[0] + (ca * alphadot * tangent + sa * tan_rate) * omega[1],
        -ca * alphadot * omega[0] - sa * alphadot * omega[1],
        (-sa * alphadot / cb + ca * secant_rate) * omega[0] + (ca * alphadot / cb + sa * secant_rate) * omega[1],
    )


def law_in(representation):
    """Return the law in Z-Y-X Euler angles."""
    chart, goal_chart = representation.chart, representation.goal_chart

    @kernel
    def law(R, omega, goal, gains):
        """u = B (u_E - d(B^-1)/dt omega), u_E = Kp (E_d - E) - Kd Edot, Edot = B^-1 omega (Murphy 1988, 2.9, 2.15)."""
        E = chart(R).E
        E_d = goal_chart(goal.R).E
        sa, ca, sb, cb = sin(E[0]), cos(E[0]), sin(E[1]), cos(E[1])
        Edot = inverse_times(sa, ca, sb, cb, omega)
        drift = inverse_rate_times(sa, ca, sb, cb, Edot, omega)
        v = (
            gains.kp * (E_d[0] - E[0]) - gains.kv * Edot[0] - drift[0],
            gains.kp * (E_d[1] - E[1]) - gains.kv * Edot[1] - drift[1],
            gains.kp * (E_d[2] - E[2]) - gains.kv * Edot[2] - drift[2],
        )
        return (-sa * v[1] + ca * cb * v[2], ca * v[1] + sa * cb * v[2], v[0] - sb * v[2])

    return law


REGULATOR = Law(
    name="feedback-linearized-literal",
    title="Feedback-linearized, as printed",
    source="Murphy 1988, (2.15)",
    attribution=PUBLISHED,
    formula=r"u = B\,\bigl(u_E - \tfrac{d}{dt}(B^{-1})\,\omega\bigr)",
    law=OnCoordinates(law_in, ("zyx-euler",)),
    role=COSTING,
    display=Display(look=Look("sky", "v", "dotted")),
)
