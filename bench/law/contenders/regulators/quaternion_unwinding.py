"""The error quaternion without its sign, a negative control: u = 2 Kp eps - Kv omega on the sheet it happens to be on.

Its quaternion is followed from tick to tick, as an attitude filter does, and begins on the sheet with eta <= 0, as half
of all quaternions do. There the law drives to eta = 1 by the longer rotation, up to 360 degrees: unwinding. On the
other sheet it would be quaternion-shortest. A reset begins on that sheet again; it is needed before the first tick,
after a pause, and when the goal jumps.

Limitations: it settles everywhere but goes the wrong way.
"""

from bench.law import CHORD, CONTROL, PUBLISHED, Display, Law, Look, kernel, spring_damper, sqrt, turn_quaternion


@kernel
def law(R, omega, goal, gains, memory):
    """u = 2 Kp eps - Kv omega; memory: the error quaternion of the last tick, whose side is kept."""
    w, v, t = turn_quaternion(R, goal.R)
    scale = 0.5 / sqrt(t)
    if memory[0] * w + memory[1] * v[0] + memory[2] * v[1] + memory[3] * v[2] < 0.0:
        scale = -scale
    eta, eps = scale * w, (scale * v[0], scale * v[1], scale * v[2])
    double = 2.0 * gains.kp
    u = spring_damper(double, eps, gains.kv, omega)
    return u, (eta, eps[0], eps[1], eps[2])


REGULATOR = Law(
    name="quaternion-unwinding",
    title="Quaternion without sign",
    source=(
        "Wen & Kreutz-Delgado 1991; the choice of the longer way at the start is ours; unwinding: "
        "Bhat & Bernstein 2000"
    ),
    attribution=PUBLISHED,
    formula=r"u = 2 K_p\,\epsilon - K_v\,\omega",
    law=law,
    memory=(-1.0, 0.0, 0.0, 0.0),
    property="none",
    is_beyond_the_paper=True,
    role=CONTROL,
    display=Display(
        "quaternion without sign",
        Look("yellow", "x", "dotted"),
        "Euler variants, controls",
        CHORD._replace(the_long_way=True),
    ),
)
