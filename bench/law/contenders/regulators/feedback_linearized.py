"""Feedback linearization in any coordinates: E obeys a linear double integrator (Murphy 1988, 2.15-2.16).

What that is, from rest towards the identity:
- Euler angles (zyx, zyz, xyz): each angle decays independently; the path bends the more, the nearer the pole.
- rotation vector: u = -Kp phi - Kd omega along the fixed axis, the angle decays linearly.
- mrp: tan(theta/4) decays linearly; u is trig-free.
- quaternion: u = -2 Kp eps - Kd omega exactly, eps = (x, y, z): what is along E moves nothing and drops out.

Where E_d and E lie on different sheets (of mrp and rotation vector past 180°, of the quaternion's sign) the
numbers are taken as they come, and the body takes the longer rotation.

Proved in Z-Y-X angles: from rest E - E_d = (E_0 - E_d) r(t), and 0 <= r <= 1 where Kd^2 >= 4 Kp, so that E stays on the
segment from E_0 to E_d, where |beta| < pi/2 and no angle jumps: every start at rest off the poles reaches every goal
off them.

Limitations: where B^-1 does not exist (in Z-Y-Z at the identity itself), and where a coordinate jumps.
"""

from bench.law import PUBLISHED, Display, Law, Look, OnCoordinates, kernel, minus, spring_damper


@kernel
def pd_of_three(at, E_d, Edot, gains):
    """u_E = Kp (E_d - E) - Kd Edot (Murphy 1988, 2.16), of three coordinates."""
    return spring_damper(gains.kp, minus(E_d, at.E), gains.kv, Edot)


@kernel
def pd_of_four(at, E_d, Edot, gains):
    """Return the PD law for four coordinates, those of a quaternion."""
    return (
        gains.kp * (E_d[0] - at.E[0]) - gains.kv * Edot[0],
        gains.kp * (E_d[1] - at.E[1]) - gains.kv * Edot[1],
        gains.kp * (E_d[2] - at.E[2]) - gains.kv * Edot[2],
        gains.kp * (E_d[3] - at.E[3]) - gains.kv * Edot[3],
    )


PD = {3: pd_of_three, 4: pd_of_four}
"""The law by the number of coordinates: compiled code knows the length of a tuple, not a loop over it."""


def coordinate_law_in(representation):
    """u_E in the coordinates of one representation, for the analytic Jacobian (Murphy 1988, 3.7)."""
    return PD[len(representation.symbols)]


def law_in(representation):
    """Return the law in the coordinates of one representation."""
    chart, rates, accelerate = representation.chart, representation.rates, representation.accelerate
    goal_chart = representation.goal_chart
    pd = coordinate_law_in(representation)

    @kernel
    def law(R, omega, goal, gains):
        """u = B u_E + Bdot Edot with u_E = Kp (E_d - E) - Kd Edot.

        -B d(B^-1)/dt omega = Bdot Edot, so this is (2.15) without an inverse to differentiate.
        Source: Murphy 1988, (2.15)-(2.16).
        """
        at = chart(R)
        E_d = goal_chart(goal.R).E
        Edot = rates(at, omega)
        return accelerate(at, Edot, pd(at, E_d, Edot, gains))

    return law


REGULATOR = Law(
    name="feedback-linearized",
    title="Feedback-linearized",
    source="Murphy 1988, (2.15)-(2.16), which has Z-Y-X angles",
    attribution=PUBLISHED,
    formula=r"u = B\,u_E + \dot B\,\dot E, \quad u_E = K_p (E_d - E) - K_d \dot E",
    law=OnCoordinates(law_in, "any", coordinate_law_in=coordinate_law_in),
    display=Display(
        "feedback-linearized",
        Look("green", "^", "dash-dot"),
        "The paper's three",
        lambda coordinates: coordinates.display.equation,
    ),
)
