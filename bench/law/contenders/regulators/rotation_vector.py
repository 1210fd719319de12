"""The rotation vector of the turn to the goal: e = theta k, a spring whose force grows with the angle to the end.

Limitations: at 180° the command jumps to its opposite.
"""

from bench.law import ANGLE, PUBLISHED, Display, Law, Look, atan2, dot, kernel, spring_damper, sqrt, turn_quaternion


@kernel
def turn_by_angle(w, v, omega, gains):
    """Kp theta k - Kv omega of the turn with the quaternion (w, v), of any length but 0: theta = 2 atan2(|v|, w)."""
    square = dot(v, v)
    if square > 0.0:
        size = sqrt(square)
        scale = 2.0 * gains.kp * atan2(size, w) / size
    else:
        scale = 2.0 * gains.kp / w
    return spring_damper(scale, v, gains.kv, omega)


@kernel
def law(R, omega, goal, gains):
    """u = Kp log(R_d R^T) - Kv omega, the logarithm by theta = 2 atan2(sin(theta/2), cos(theta/2)) in [0, pi]."""
    w, v, _ = turn_quaternion(R, goal.R)
    return turn_by_angle(w, v, omega, gains)


REGULATOR = Law(
    name="rotation-vector",
    title="Rotation vector",
    source="Bullo & Murray 1995; also Caccavale et al. 1999 (angle/axis)",
    attribution=PUBLISHED,
    formula=r"u = K_p \log(R_d R^\top) - K_v\,\omega",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    display=Display("rotation vector", Look("sky", "o", "solid"), "On three parameters", ANGLE),
)
