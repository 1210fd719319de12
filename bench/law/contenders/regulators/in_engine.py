"""MuJoCo's <orientation> actuator: what a user of the simulator gets who writes no law, a servo along the geodesic.

It is run in MuJoCo, in place of our motors, with the goal as its control; the rotation vector's law is what it
computes, to rounding. Within 1e-15 rad of 180° rounding chooses the side, and at exactly 180° q and -q, one attitude,
are pushed opposite ways.

Limitations: at 180° the command jumps to its opposite.
"""

from bench.law import (
    ACTUATOR,
    PUBLISHED,
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


@kernel
def law(R, omega, goal, gains):
    """u = Kp theta k - Kv omega, what the actuator computes; counted from R, where MuJoCo begins with a quaternion."""
    w, v, _ = turn_quaternion(R, goal.R)
    size = sqrt(dot(v, v))
    pull = gains.kp * (2.0 * atan2(size, w) / size if size > 0.0 else 0.0)
    return spring_damper(pull, v, gains.kv, omega)


REGULATOR = Law(
    name="in-engine",
    title="MuJoCo's orientation actuator",
    source="MuJoCo documentation, XML reference, actuator/orientation (version 3.11)",
    attribution=PUBLISHED,
    formula=r"u = K_p \log(R_d R^\top) - K_v\,\omega",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    role=ACTUATOR,
    display=Display("MuJoCo's actuator", Look("blue", "*", "dotted"), "On three parameters"),
)
