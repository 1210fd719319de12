"""The square root of the paper's error: sin(theta) k divided by cos(theta/2), from the matrix alone.

    e = s / sqrt(1 + t) = 2 sin(theta/2) k,   s = n x n_d + o x o_d + a x a_d,   t = tr(R_d^T R)

It is the error quaternion's vector part, of the shorter rotation, with one square root and no other function. Where
t < 0 that division would lose digits and at 180° divide zero by zero: there it is taken from the largest
diagonal element (`so3.turn_quaternion`).

Limitations: at 180° the command jumps to its opposite, and on it the sign is a rule's.
"""

from bench.law import (
    CHORD,
    PUBLISHED,
    Display,
    Law,
    Look,
    double_sine,
    kernel,
    spring_damper,
    sqrt,
    trace,
    turn_quaternion,
)


@kernel
def law(R, omega, goal, gains):
    """u = Kp s / sqrt(1 + t) - Kv omega; all in the base frame."""
    t = trace(R, goal.R)
    if t < 0.0:
        _, s, square = turn_quaternion(R, goal.R)
        scale = gains.kp / sqrt(square)
    else:
        s = double_sine(R, goal.R)
        scale = gains.kp / sqrt(1.0 + t)
    return spring_damper(scale, s, gains.kv, omega)


REGULATOR = Law(
    name="square-root",
    title="Square root of the trace",
    source="Lee 2012; equal to Yuan 1988",
    attribution=PUBLISHED,
    formula=r"u = K_p\, s / \sqrt{1 + t} - K_v\,\omega",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    display=Display("square root", Look("blue", "D", "solid"), "On the matrix", CHORD),
)
