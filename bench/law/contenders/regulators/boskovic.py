"""Boskovic, Li and Mehra's bounded law: the command never reaches the bound of the motor.

    u = Kv s/(1 + Kv |s|/bound)      s = 2 (Kp/Kv) eps - omega

(eta, eps) is the quaternion of the turn from R to R_d, eta >= 0. |u| = Kv |s|/(1 + Kv |s|/bound) <
bound at every orientation and every rate. Near the goal, where |s| is small, u = Kp phi - Kv omega.
Without a bound the law is `quaternion_shortest`.

Source: Boskovic, Li, Mehra 2001, J. Guidance, Control, Dynamics. We read the law in two later
codes, not in the paper: u_i = u_max s_i/(|s_i| + k^2 delta), s = k^2 eps - omega in our
signs, with a gain k that is adapted. So k^2 = 2 Kp/Kv and delta = bound/(2 Kp) here. Ours are: the
whole vector in place of each component, so that the direction of s is kept; the constant k; and the
nearer of the two quaternions.

Limitations: at 180° the command jumps to its opposite. The law gives less than the motor can: where
the law without a bound commands just the bound, this one commands half of it. It does not plan its
braking: with a small bound the body passes the goal.
"""

from bench.law import (
    ADAPTED,
    CHORD,
    Display,
    Law,
    Look,
    dot,
    kernel,
    spring_damper,
    sqrt,
    turn_quaternion,
)


@kernel
def law(R, omega, goal, gains):
    """u = Kv s/(1 + Kv |s|/bound), Kv s = 2 Kp eps - Kv omega, eta >= 0; all in the base frame."""
    _, v, t = turn_quaternion(R, goal.R)
    free = spring_damper(gains.kp / sqrt(t), v, gains.kv, omega)
    share = 1.0 / (1.0 + sqrt(dot(free, free)) / gains.bound)
    return (share * free[0], share * free[1], share * free[2])


REGULATOR = Law(
    name="boskovic",
    title="Boskovic, Li, Mehra's bounded law",
    source=(
        "after Boskovic, Li, Mehra 2001 (we read two later codes, not the paper); "
        "the bound of the whole vector and the constant gain are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = \frac{K_v\,s}{1 + K_v |s|/u_{\max}}, \quad"
    r" s = 2 \tfrac{K_p}{K_v}\,\epsilon - \omega",
    law=law,
    is_beyond_the_paper=True,
    display=Display(
        "Boskovic, Li, Mehra", Look("green", "d", "dash-dot"), "With the bound of the motor", CHORD
    ),
)
