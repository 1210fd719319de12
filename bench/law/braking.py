"""The greatest angular velocity that a motor with a bound can still brake before the goal.

A body that turns to its goal at the rate c, and that brakes with the acceleration a, stops after
the angle c^2/(2 a). Therefore the greatest rate at the angle theta is sqrt(2 a theta). Near the
goal this root is too steep for a loop with finite gains. There the rate is p theta.

Source: ArduPilot, libraries/AP_Math/control.cpp at 00b6cbbf, function `sqrt_controller` (read).
"""

from bench.law.scalar import kernel, sqrt


@kernel
def shifted_root(theta, p, a):
    """Compute the rate c(theta) to the goal [rad/s] and its slope dc/dtheta [1/s].

        c = p theta                       for theta <= d,   d = a/p^2
        c = sqrt(2 a (theta - d/2))       for theta > d

    At theta = d both branches have the value a/p and the slope p. A body with the rate c decelerates by c dc/dtheta,
    which is at most a.

    Args:
        theta: angle to the goal [rad], at least 0.
        p: slope of the rate at the goal [1/s].
        a: greatest deceleration [rad/s^2]; infinite if there is no bound.
    """
    rate = p * theta
    slope = p
    if p * rate > a:
        rate = sqrt(a * (2.0 * theta - a / (p * p)))
        slope = a / rate
    return rate, slope
