"""The linearized regulator typed as the paper prints it, u = -Kp E - Kd Edot: a negative control.

(2.14) maps u_x to gammaddot and u_z to alphaddot; without that permutation alpha is driven by gamma and gamma by
alpha. Limitations: unstable at the goal itself.
"""

from bench.law import ADAPTED, CONTROL, Display, Law, Look, OnCoordinates, kernel, minus, spring_damper


def law_in(representation):
    """Return the law in Z-Y-X Euler angles."""
    chart, rates, goal_chart = representation.chart, representation.rates, representation.goal_chart

    @kernel
    def law(R, omega, goal, gains):
        """u = Kp (E_d - E) - Kd Edot, component by component (Murphy 1988, 2.3, as printed)."""
        at = chart(R)
        E_d = goal_chart(goal.R).E
        return spring_damper(gains.kp, minus(E_d, at.E), gains.kv, rates(at, omega))

    return law


REGULATOR = Law(
    name="linearized-euler-literal",
    title="Linearized Euler, as printed",
    source="after Murphy 1988, 2.3, without the permutation of (2.14); a wrong law, to check our tests",
    attribution=ADAPTED,
    formula=r"u = K_p (E_d - E) - K_d \dot E",
    law=OnCoordinates(law_in, ("zyx-euler",)),
    property="none",
    role=CONTROL,
    display=Display("Euler as printed", Look("orange", "x", "dotted"), "Euler variants, controls"),
)
