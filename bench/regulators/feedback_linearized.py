"""Feedback linearization in any coordinates: E obeys a linear double integrator (Murphy 1988, 2.15-2.16).

Fails: where B^-1 does not exist, and where a coordinate jumps.
"""

from bench.contender import Regulator
from bench.scalar import kernel


def law_in(representation):
    """The law in the coordinates of one representation."""
    chart, rates, accelerate = representation.chart, representation.rates, representation.accelerate
    goal_chart = representation.goal_chart

    @kernel
    def law(R, omega, goal, gains):
        """u = B u_E + Bdot Edot with u_E = Kp (E_d - E) - Kd Edot.

        -B d(B^-1)/dt omega = Bdot Edot, so this is (2.15) without an inverse to differentiate.
        Source: Murphy 1988, (2.15)-(2.16).
        """
        at = chart(R)
        E_d = goal_chart(goal.R).E
        Edot = rates(at, omega)
        u_E = (
            gains.kp * (E_d[0] - at.E[0]) - gains.kv * Edot[0],
            gains.kp * (E_d[1] - at.E[1]) - gains.kv * Edot[1],
            gains.kp * (E_d[2] - at.E[2]) - gains.kv * Edot[2],
        )
        return accelerate(at, Edot, u_E)

    return law


REGULATOR = Regulator(
    name="feedback-linearized",
    title="Feedback-linearized",
    source="Murphy 1988, (2.15)-(2.16)",
    formula=r"u = B\,u_E + \dot B\,\dot E, \quad u_E = K_p (E_d - E) - K_d \dot E",
    law_in=law_in,
    coordinates="any",
    property="local",
)
