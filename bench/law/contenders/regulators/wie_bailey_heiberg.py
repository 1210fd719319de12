"""A cascade whose commanded rate is the lesser of two: that of the error quaternion, and one that can be braked.

    u = Kv (c e - omega)      c = min(2 (Kp/Kv) |eps|, sqrt(4 a |eps|)),   e = eps/|eps|

Here (eta, eps) is the quaternion of the turn from R to R_d with eta >= 0, and a is SHARE times
the bound of the command. Near the goal the command is 2 Kp eps - Kv omega. Far from it, sqrt(4 a
|eps|) is nearly sqrt(2 a theta), the greatest rate that the acceleration a can brake. The two
branches meet with different slopes: just below the knee the law needs the deceleration 2 a, twice
what it plans with. Without a bound the law is `quaternion_shortest`.

Source: Wie, Bailey, Heiberg 2002, J. Guidance, Control, Dynamics 25(1) 96-104. We did not read
the paper; the formula is from later reports on it. There each component has its own limit, and
there is an integral and a greatest rate. The limit of the whole vector and SHARE are ours.

Limitations: at 180° the command jumps to its opposite. With more than half of the bound the body
can pass the goal, because of the knee; and it brakes too late if the body is more inert than its
model.
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

SHARE = 0.7
"""Share of the bound that the law plans to brake with; ours."""


@kernel
def turn_at_lesser_rate(v, root, omega, gains):
    """Compute Kv (c e - omega) of the turn with the vector part v = 2 root eps."""
    pull = 2.0 * gains.kp
    eps = 0.5 * sqrt(dot(v, v)) / root
    a = SHARE * gains.bound
    if gains.kp * gains.kp * eps > a * gains.kv * gains.kv:
        pull = 2.0 * gains.kv * sqrt(a / eps)
    return spring_damper(0.5 * pull / root, v, gains.kv, omega)


@kernel
def law(R, omega, goal, gains):
    """u = Kv (c e - omega), (eta, eps) of the turn from R to R_d with eta >= 0; all in the base frame."""
    _, v, t = turn_quaternion(R, goal.R)
    return turn_at_lesser_rate(v, sqrt(t), omega, gains)


REGULATOR = Law(
    name="wie-bailey-heiberg",
    title="Wie, Bailey and Heiberg's cascade",
    source=(
        "after Wie, Bailey, Heiberg 2002 (we read later reports, not the paper); "
        "the limit of the whole vector and the share 0.7 of the bound are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = K_v\Bigl(\min\bigl(2 \tfrac{K_p}{K_v}|\epsilon|,\, \sqrt{4 a |\epsilon|}\bigr)"
    r"\,\tfrac{\epsilon}{|\epsilon|} - \omega\Bigr)",
    law=law,
    is_beyond_the_paper=True,
    display=Display("Wie, Bailey, Heiberg", Look("blue", "<", "dotted"), "With the bound of the motor", CHORD),
)
