"""Brescianini's attitude loop: an error quaternion, and a rule that lets a fast spin go on around.

    u = Kv (omega_c - omega)      omega_c = 2 p sgn(eta) eps, in body axes, p = Kp/Kv

The spin rule acts on each body axis: where omega_c,i and omega_i have opposite signs and |omega_i|
exceeds a threshold, omega_c,i becomes the greatest rate in the direction of omega_i. So the body
does not brake a fast spin. It goes on until it has passed 180° from the goal, and brakes on the way
to the goal. The rule is the firmware's, in units of its gain of 4 1/s: the threshold is 12 rad/s =
3 p about x and y and 5 rad/s = 1.25 p about z; the greatest rate is 30 rad/s = 7.5 p about x and y
and 10 rad/s = 2.5 p about z. The firmware then shortens omega_c to its greatest rates. This never
acts here, since 2 p |eps_i| <= 2 p. From rest the rate never exceeds 2 p.

Source: Brescianini, Hehn, D'Andrea 2013, Nonlinear quadrocopter attitude control, report of ETH
Zurich, as in the Crazyflie firmware, src/modules/src/controller/controller_brescianini.c at
1c57f1a9. We read the firmware, not the report. The firmware's loop of the rate is twice as fast
about z as about x and y; equal gains on all axes are ours.

Limitations: at 180°, and where the rule begins to act, the command jumps. The rule looks at the
sign of the error alone: close to the goal too it speeds a fast spin up and sends the body around
once more. The rule can hold a body in a spin for ever: omega_z stays at 2.5 p, eps_z stays opposed
to it, and the body never passes 180°. A few tumbling starts of this benchmark end so, with the
firmware's ratio of gains Kv/p = 17 too. The greatest command is large, Kv 4.5 p about x or y where
the rule begins to act: a weak motor cannot give it.
"""

from bench.law import (
    ADAPTED,
    CHORD,
    Display,
    Law,
    Look,
    kernel,
    quaternion_direction,
    relative,
    rotate,
    rotate_back,
    spring_damper,
    sqrt,
)

FAST_TILT = 3.0
"""Rate about x and y above which the spin goes on, over Kp/Kv."""
FAST_YAW = 1.25
"""Rate about z above which the spin goes on, over Kp/Kv."""
GREATEST_TILT = 7.5
"""Rate with which the spin goes on about x and y, over Kp/Kv."""
GREATEST_YAW = 2.5
"""Rate with which the spin goes on about z, over Kp/Kv."""


@kernel
def go_on(rate, spin, fast, greatest):
    """Return the wanted rate, or the greatest one along a spin that is fast and opposed to it."""
    wanted = rate
    if rate * spin < 0.0:
        if spin > fast:
            wanted = greatest
        if spin < -fast:
            wanted = -greatest
    return wanted


@kernel
def law(R, omega, goal, gains):
    """u = Kv (R omega_c - omega), omega_c = 2 p eps in body axes, eta >= 0, with the spin rule."""
    (_, x, y, z), t = quaternion_direction(relative(R, goal.R))
    spin = rotate_back(R, omega)
    p = gains.kp / gains.kv
    scale = p / sqrt(t)
    rate_body = (
        go_on(scale * x, spin[0], FAST_TILT * p, GREATEST_TILT * p),
        go_on(scale * y, spin[1], FAST_TILT * p, GREATEST_TILT * p),
        go_on(scale * z, spin[2], FAST_YAW * p, GREATEST_YAW * p),
    )
    return spring_damper(gains.kv, rotate(R, rate_body), gains.kv, omega)


REGULATOR = Law(
    name="brescianini",
    title="Brescianini's attitude loop with spin rule",
    source=(
        "after Brescianini, Hehn, D'Andrea 2013 and the Crazyflie firmware "
        "(we read the firmware, not the report); equal gains on all axes are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = K_v(\omega_c - \omega), \quad"
    r" \omega_c = 2 \tfrac{K_p}{K_v}\operatorname{sgn}(\eta)\,\epsilon,"
    r" \quad \omega_{c,i} \to \omega_{\max,i}\operatorname{sgn}(\omega_i)"
    r" \text{ where } \omega_{c,i}\,\omega_i < 0,\ |\omega_i| > \omega_{h,i}",
    law=law,
    is_beyond_the_paper=True,
    display=Display("Brescianini", Look("orange", "d", "dotted"), "On the quaternion", CHORD),
)
