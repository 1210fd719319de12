"""A cascade: the error quaternion asks for a rate of turning, of a greatest size, and the damper brings it about.

    u = Kv (omega_c - omega)      omega_c = 2 (Kp/Kv) eps, shortened to SLEW Kp/Kv

Near the goal that is 2 Kp eps - Kv omega. The vector is shortened whole, so that from rest the turn keeps its axis, and
the body never turns faster than SLEW Kp/Kv, 5 rad/s at the paper's gains: |omega|^2 falls there. PX4 and ArduPilot have
cascades of this kind. V = Kp U + |omega|^2/2, U' = min(2 sin(theta/2), SLEW), falls as -Kv |omega|^2.

Source: Wie & Lu 1995; neither the paper nor the book after it was read: the formula u = -J (2 k sat(eps) + c omega) is
from later reports on it, and there each component is cut. To cut the whole vector, and SLEW, are ours: 1 limits the
rate from 60 degrees on. The law is not ranked by one SLEW: `python -P -m bench.studies.constants` varies it.

Limitations: at 180° the command jumps to its opposite; from far away it takes theta Kv/(SLEW Kp).
"""

from bench.law import ADAPTED, Display, Equation, Law, Look, dot, kernel, sin, spring_damper, sqrt, turn_quaternion

SLEW = 1.0
"""Greatest rate of turning, over Kp/Kv; ours."""


@kernel
def law(R, omega, goal, gains):
    """u = Kp min(1, SLEW/|2 eps|) 2 eps - Kv omega, (eta, eps) of the turn from R to R_d, eta >= 0; base frame."""
    _, v, t = turn_quaternion(R, goal.R)
    # 2 eps = v/sqrt(t): of the two that v may be divided by the greater
    square = dot(v, v) / (SLEW * SLEW)
    if square < t:
        square = t
    return spring_damper(gains.kp / sqrt(square), v, gains.kv, omega)


REGULATOR = Law(
    name="slew-limited",
    title="Slew-limited quaternion cascade",
    source=(
        "after Wie & Lu 1995 (we read later reports, not the paper); the limit of the whole vector "
        "and the largest rate Kp/Kv are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = K_v\Bigl(\operatorname{sat}_{\omega_{\max}}\bigl(2 \tfrac{K_p}{K_v}\,\epsilon\bigr) - \omega\Bigr)",
    law=law,
    property="almost global",
    later=True,
    display=Display(
        "slew limited",
        Look("blue", "h", "dashed"),
        "On the quaternion",
        Equation(r"\min(2 \sin(\theta/2),\, 1)", lambda theta: min(2.0 * sin(theta / 2.0), SLEW)),
    ),
)
