"""The error quaternion (eta, eps) of the shorter rotation: e = 2 sgn(eta) eps = 2 sin(theta/2) k.

Limitations: at 180° the command jumps to its opposite. sgn(0) is 1 here: a law that takes it for 0 rests
there for ever.
"""

from bench.law import CHORD, PUBLISHED, Display, Law, Look, kernel, spring_damper, sqrt, turn_quaternion


@kernel
def law(R, omega, goal, gains):
    """u = 2 Kp sgn(eta) eps - Kv omega, (eta, eps) the unit quaternion of the turn from R to R_d, base frame."""
    _, eps, t = turn_quaternion(R, goal.R)
    scale = gains.kp / sqrt(t)
    return spring_damper(scale, eps, gains.kv, omega)


REGULATOR = Law(
    name="quaternion-shortest",
    title="Shortest quaternion",
    source="Yuan 1988; also Wie, Weiss, Arapostathis 1989",
    attribution=PUBLISHED,
    formula=r"u = 2 K_p\,\operatorname{sgn}(\eta)\,\epsilon - K_v\,\omega",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    display=Display("shortest quaternion", Look("purple", "o", "solid"), "On the quaternion", CHORD),
)
