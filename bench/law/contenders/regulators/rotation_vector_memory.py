"""The rotation vector of the turn to the goal, its side kept in memory: e = theta k, theta up to 227 degrees.

The straight spring of `rotation_vector`, on the quaternion that `bench.law.side` keeps. The memory outlives
the goal: reset it before the first tick and after a pause. When the goal jumps, a reset shortens the way and
saves no time.

Global: V = Kp theta^2/2 + |omega|^2/2 has Vdot = -Kv |omega|^2, the force is zero at the goal alone, and a change of
side takes theta from 2 acos(-DELTA) to 2 acos(DELTA), 133 degrees, and so takes from V.
Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way, and so it may without a reset when the goal jumps.
"""

from bench.law import ADAPTED, ANGLE, DELTA, Display, Law, Look, kernel, turn_on_kept_side
from bench.law.contenders.regulators.rotation_vector import turn_by_angle


@kernel
def law(R, omega, goal, gains, memory):
    """u = Kp theta k - Kv omega, theta k on the kept side; memory: the quaternion (w, v) of the last tick."""
    w, v, _ = turn_on_kept_side(R, goal.R, memory, DELTA)
    return turn_by_angle(w, v, omega, gains), (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="rotation-vector-memory",
    title="Rotation vector with memory",
    source="after Bullo & Murray 1995 and Mayhew, Sanfelice, Teel 2011",
    attribution=ADAPTED,
    formula=r"u = K_p\,\theta\,k - K_v\,\omega, \quad \theta \le 2\arccos(-\delta)",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    is_beyond_the_paper=True,
    display=Display("rotation vector with memory", Look("sky", "P", "dashed"), "With memory", ANGLE),
)
