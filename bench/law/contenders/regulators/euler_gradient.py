"""Feedback linearization without the term Bdot Edot, and so without B^-1: u = Kp B (E_d - E) - Kv omega.

Limitations: where a coordinate jumps.
"""

from bench.law import ADAPTED, Display, Law, Look, OnCoordinates, kernel, minus, spring_damper


def law_in(representation):
    """Return the law in the coordinates of one representation."""
    chart, goal_chart, push = representation.chart, representation.goal_chart, representation.angular_velocity

    @kernel
    def law(R, omega, goal, gains):
        """u = Kp B (E_d - E) - Kv omega."""
        at = chart(R)
        e = push(at, minus(goal_chart(goal.R).E, at.E))
        return spring_damper(gains.kp, e, gains.kv, omega)

    return law


REGULATOR = Law(
    name="euler-gradient",
    title="Euler gradient",
    source="after Murphy 1988, (2.15), without its term Bdot Edot",
    attribution=ADAPTED,
    formula=r"u = K_p\, B\,(E_d - E) - K_v\,\omega",
    law=OnCoordinates(law_in, ("zyx-euler",)),
    is_beyond_the_paper=True,
    display=Display("Euler gradient", Look("sky", "s", "dashed"), "Euler variants, controls"),
)
