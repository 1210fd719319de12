"""The square-root law with one quaternion of memory: global, with no point of rest but the goal.

The error quaternion is followed from tick to tick, and its sign changed only where its scalar part has fallen below
-DELTA: near a 180° rotation the law keeps the side it has begun on, so that noise does not hold it there. No
continuous law without memory can do it (Bhat & Bernstein 2000). The memory outlives the goal: reset it before the first
tick, after a pause, and when the goal jumps.

Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way, and so it may without a reset when the goal jumps.
"""

from bench.law import CHORD, Display, Law, Look, kernel, spring_damper, sqrt, turn_quaternion

DELTA = 0.4
"""Half the width of the hysteresis, in eta = cos(theta/2)."""


@kernel
def law(R, omega, goal, gains, memory):
    """u = 2 Kp h eps - Kv omega; memory: the quaternion (w, v) of the last tick, of any length, whose side h is kept.

    Here (eta, eps) = (w, v)/(2 root): eta and eps themselves are needed nowhere.
    """
    w, v, t = turn_quaternion(R, goal.R)
    root = sqrt(t)
    kept = memory[0] * w + memory[1] * v[0] + memory[2] * v[1] + memory[3] * v[2]
    if kept < 0.0 and w < 2.0 * DELTA * root:
        w, v = -w, (-v[0], -v[1], -v[2])
    pull = gains.kp / root
    u = spring_damper(pull, v, gains.kv, omega)
    return u, (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="hybrid",
    title="Hybrid, with one quaternion of memory",
    source="Mayhew, Sanfelice, Teel 2011",
    formula=r"u = 2 K_p\, h\,\epsilon - K_v\,\omega, \quad h^+ = -h \text{ where } h\,\eta < -\delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    later=True,
    display=Display("hybrid", Look("vermillion", "P", "dashed"), "On the quaternion", CHORD),
)
