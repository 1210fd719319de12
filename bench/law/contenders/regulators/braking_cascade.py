"""A cascade whose commanded rate is the greatest one that the motor can still brake before the goal.

    u = Kv (c(theta) k - omega)      theta, k: angle and axis of the turn from R to R_d

Near the goal c = (Kp/Kv) theta, so that u = Kp theta k - Kv omega. Far from the goal c = sqrt(2 a
(theta - d/2)), with d = a/(Kp/Kv)^2 and a = SHARE times the bound of the command. A body with the
rate c decelerates by at most a. Without a bound the law is the law of the rotation vector.

Source: ArduPilot, `sqrt_controller` in libraries/AP_Math/control.cpp at 00b6cbbf, and its use on
the attitude error in libraries/AC_AttitudeControl/AC_AttitudeControl.cpp at 00f02a67 (both read).
There the root acts on each component of the error with half of the greatest acceleration. The
root of the whole angle, so that a turn from rest keeps its axis, and SHARE are ours.

Limitations: at 180° the command jumps to its opposite. If the body is more inert than its model,
it brakes too late: the true share is SHARE times the true inertia over the modelled one, and
above 1 the body passes the goal.
"""

from bench.law import (
    ADAPTED,
    ANGLE,
    Display,
    Law,
    Look,
    atan2,
    dot,
    kernel,
    spring_damper,
    sqrt,
    turn_quaternion,
)
from bench.law.braking import shifted_root

SHARE = 0.7
"""Share of the bound that the law plans to brake with; ours. ArduPilot plans with a half."""


@kernel
def turn_at_brakeable_rate(w, v, omega, gains):
    """Compute Kv (c(theta) k - omega) of the turn with the quaternion (w, v), of any length but 0."""
    size = sqrt(dot(v, v))
    if size > 0.0:
        theta = 2.0 * atan2(size, w)
        rate, _ = shifted_root(theta, gains.kp / gains.kv, SHARE * gains.bound)
        scale = gains.kv * rate / size
    else:
        scale = 2.0 * gains.kp / w
    return spring_damper(scale, v, gains.kv, omega)


@kernel
def law(R, omega, goal, gains):
    """u = Kv (c(theta) k - omega), c: the rate of `bench.law.braking.shifted_root`; all in the base frame."""
    w, v, _ = turn_quaternion(R, goal.R)
    return turn_at_brakeable_rate(w, v, omega, gains)


REGULATOR = Law(
    name="braking-cascade",
    title="Braking cascade",
    source="after ArduPilot's sqrt_controller; the root of the whole angle and the share 0.7 of the bound are ours",
    attribution=ADAPTED,
    formula=r"u = K_v\bigl(c(\theta)\,k - \omega\bigr), \quad c = \sqrt{2a(\theta - d/2)}"
    r" \text{ beyond } d = a K_v^2/K_p^2,\ \tfrac{K_p}{K_v}\theta \text{ below}",
    law=law,
    is_beyond_the_paper=True,
    display=Display("braking cascade", Look("blue", "h", "dashed"), "With the bound of the motor", ANGLE),
)
