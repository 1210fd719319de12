"""The square-root law with one quaternion of memory: global, with no point of rest but the goal.

The error quaternion is on the side that `bench.law.side` keeps: near a 180° rotation the law goes on as it
has begun, so that noise does not hold it there. The memory outlives the goal: reset it before the first tick
and after a pause. When the goal jumps, a reset shortens the way and saves no time.

Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way, and so it may without a reset when the goal jumps.
"""

from bench.law import CHORD, DELTA, PUBLISHED, Display, Law, Look, kernel, spring_damper, turn_on_kept_side


@kernel
def law(R, omega, goal, gains, memory):
    """u = 2 Kp h eps - Kv omega; memory: the quaternion (w, v) of the last tick, of any length, whose side h is kept.

    Here (eta, eps) = (w, v)/(2 root): eta and eps themselves are needed nowhere.
    """
    w, v, root = turn_on_kept_side(R, goal.R, memory, DELTA)
    pull = gains.kp / root
    u = spring_damper(pull, v, gains.kv, omega)
    return u, (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="hybrid",
    title="Hybrid, with memory",
    source="Mayhew, Sanfelice, Teel 2011",
    attribution=PUBLISHED,
    formula=r"u = 2 K_p\, h\,\epsilon - K_v\,\omega, \quad h^+ = -h \text{ where } h\,\eta < -\delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    is_beyond_the_paper=True,
    display=Display("hybrid", Look("sky", "P", "dashed"), "On the quaternion", CHORD),
)
