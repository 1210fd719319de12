"""PD on the Euler model linearized about zero, gains in the order that (2.14) asks for (Murphy 1988, 2.3).

The paper writes u = -Kp E - Kd Edot and regulates to zero; here the goal's angles are subtracted, so that other goals
can be asked for. Limitations: far from zero angles, where B is no longer the permutation of (2.14), and through the
pole.
"""

from bench.law import PUBLISHED, Display, Law, Look, OnCoordinates, kernel, minus, spring_damper


def law_in(representation):
    """Return the law in Z-Y-X Euler angles."""
    chart, rates, goal_chart = representation.chart, representation.rates, representation.goal_chart

    @kernel
    def law(R, omega, goal, gains):
        """u = (u_gamma, u_beta, u_alpha) with u_E = Kp (E_d - E) - Kd Edot (Murphy 1988, 2.14)."""
        at = chart(R)
        E_d = goal_chart(goal.R).E
        u_alpha, u_beta, u_gamma = spring_damper(gains.kp, minus(E_d, at.E), gains.kv, rates(at, omega))
        return (u_gamma, u_beta, u_alpha)

    return law


REGULATOR = Law(
    name="linearized-euler",
    title="Linearized Euler",
    source="Murphy 1988, (2.14); the use of goals other than zero is ours",
    attribution=PUBLISHED,
    formula=r"u = P\,\bigl(K_p (E_d - E) - K_d \dot E\bigr), \quad P: (\alpha, \beta, \gamma) \mapsto "
    r"(\gamma, \beta, \alpha)",
    law=OnCoordinates(law_in, ("zyx-euler",)),
    display=Display("linearized Euler", Look("vermillion", "s", "dashed"), "The paper's three"),
)
