"""The linearized regulator on the angles seen from the goal, the cure that the paper proposes (Murphy 1988, 2.4).

Limitations: as linearized-euler does, but at the same errors for every goal.
"""

from bench.law import ADAPTED, Display, Law, Look, OnCoordinates, kernel, relative, rotate, rotate_back


def law_in(representation):
    """Return the law in the Z-Y-X Euler angles of R_d^T R."""
    chart, rates = representation.chart, representation.rates

    @kernel
    def law(R, omega, goal, gains):
        """u = R_d u_r, u_r = -(Kp E + Kd Edot) in the order gamma, beta, alpha; E the angles of R_d^T R."""
        at = chart(relative(goal.R, R))
        Edot = rates(at, rotate_back(goal.R, omega))
        u_r = (
            -(gains.kp * at.E[2] + gains.kv * Edot[2]),
            -(gains.kp * at.E[1] + gains.kv * Edot[1]),
            -(gains.kp * at.E[0] + gains.kv * Edot[0]),
        )
        return rotate(goal.R, u_r)

    return law


REGULATOR = Law(
    name="linearized-euler-relative",
    title="Linearized Euler, from the goal",
    source="after Murphy 1988, 2.4, which proposes this law in words",
    attribution=ADAPTED,
    formula=r"u = R_d\, P\,(-K_p E - K_d \dot E), \quad E = E(R_d^\top R)",
    law=OnCoordinates(law_in, ("zyx-euler",), relative=True),
    display=Display("linearized, from goal", Look("purple", "D", "dash-dot"), "Euler variants, controls"),
)
