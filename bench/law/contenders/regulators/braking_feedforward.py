"""The braking cascade with the acceleration of its commanded rate fed forward, on the side kept in memory.

    u = c0 (c(theta) k - omega) + g d(c k)/dt

The derivative follows from theta' = -k.omega and k' = -(cot(theta/2) omega_perp + k x omega)/2:

    d(c k)/dt = -c' (k.omega) k - (c/2) (cot(theta/2) omega_perp + k x omega),   omega_perp = omega - (k.omega) k

With g = 1 the difference omega - c k decays as exp(-c0 t) while the motor carries the command
out, whatever the spin; a cascade without the derivative lags. Near the goal the law has to be Kp
theta k - Kv omega, so that c0 p = Kp and c0 + g p = Kv, p the slope of c at the goal. These have
a solution with g = 1 only if Kv^2 >= 4 Kp: c0 is then the greater root of c0^2 - Kv c0 + Kp.
Below that damping g is the greatest share that a solution has, Kv^2/(4 Kp), at c0 = Kv/2. The
rate c is that of `braking_cascade`, the side that of `bench.law.side`. The memory outlives the
goal: reset it before the first tick and after a pause. When the goal jumps, a reset shortens the
way and saves no time.

Source: this benchmark, 2026; the rate after ArduPilot's sqrt_controller, the memory after Mayhew,
Sanfelice, Teel 2011. Nobody else has reviewed the law.

Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way. If the body is more inert than its model, it brakes too late. The derivative needs the rate
omega with less delay than the law alone.
"""

from bench.law import (
    ANGLE,
    DELTA,
    OURS,
    Display,
    Law,
    Look,
    atan2,
    cross,
    dot,
    kernel,
    spring_damper,
    sqrt,
    turn_on_kept_side,
)
from bench.law.braking import shifted_root

SHARE = 0.7
"""Share of the bound that the law plans to brake with; ours."""


@kernel
def split_gains(kp, kv):
    """Compute c0 and g with c0 p = Kp and c0 + g p = Kv, where g is 1 or the greatest share below 1."""
    half = 0.5 * kv
    surplus = half * half - kp
    c0 = half
    g = half * half / kp
    if surplus >= 0.0:
        c0 = half + sqrt(surplus)
        g = 1.0
    return c0, g


@kernel
def law(R, omega, goal, gains, memory):
    """u = c0 (c k - omega) + g d(c k)/dt, theta k on the kept side; memory: the quaternion (w, v) of the last tick."""
    w, v, _ = turn_on_kept_side(R, goal.R, memory, DELTA)
    size = sqrt(dot(v, v))
    if size > 0.0:
        c0, g = split_gains(gains.kp, gains.kv)
        rate, slope = shifted_root(2.0 * atan2(size, w), gains.kp / c0, SHARE * gains.bound)
        k = (v[0] / size, v[1] / size, v[2] / size)
        along = dot(k, omega)
        # d(c k)/dt = -radial k - across omega - turning (k x omega), the part of omega along k counted apart
        turning = 0.5 * rate
        across = turning * w / size
        radial = (slope - across) * along
        sideways = cross(k, omega)
        pull = c0 * rate - g * radial
        damper = c0 + g * across
        swing = g * turning
        u = (
            pull * k[0] - damper * omega[0] - swing * sideways[0],
            pull * k[1] - damper * omega[1] - swing * sideways[1],
            pull * k[2] - damper * omega[2] - swing * sideways[2],
        )
    else:
        u = spring_damper(2.0 * gains.kp / w, v, gains.kv, omega)
    return u, (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="braking-feedforward",
    title="Braking cascade with feedforward",
    source="this benchmark, 2026; after ArduPilot's sqrt_controller and Mayhew, Sanfelice, Teel 2011",
    attribution=OURS,
    formula=r"u = c_0\bigl(c(\theta)\,k - \omega\bigr) + g\,\tfrac{d}{dt}\bigl(c(\theta)\,k\bigr),"
    r" \quad c_0\,p = K_p,\ c_0 + g\,p = K_v",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    is_beyond_the_paper=True,
    display=Display(
        "braking cascade with feedforward",
        Look("purple", "<", "dash-dot"),
        "With the bound of the motor",
        ANGLE,
    ),
)
