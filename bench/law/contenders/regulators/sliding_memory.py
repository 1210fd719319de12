"""Sliding on omega = lambda eps, the side of the quaternion (eta, eps) kept in memory.

The law of `sliding`, on the quaternion that `bench.law.side` keeps. The memory outlives the goal: reset it
before the first tick and after a pause. When the goal jumps, a reset shortens the way and saves no time.

Global: V = 4 Kp (1 - eta) + |omega|^2/2 has Vdot = -(K + (lambda/2) eta) |omega|^2, where K >= lambda/2 and eta >=
-DELTA; eps is zero at the goal alone, and a change of side takes 8 DELTA Kp from V.
Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way, and so it may without a reset when the goal jumps.
"""

from bench.law import ADAPTED, DELTA, Display, Law, Look, kernel, turn_on_kept_side
from bench.law.contenders.regulators.sliding import SLIDING, slide


@kernel
def law(R, omega, goal, gains, memory):
    """u = -(lambda/2)(eta omega + eps x omega) - K (omega - lambda eps); memory: the quaternion of the last tick."""
    w, v, root = turn_on_kept_side(R, goal.R, memory, DELTA)
    return slide(w, v, root, omega, gains), (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="sliding-memory",
    title="Sliding on the quaternion, with memory",
    source="after Egeland & Godhavn 1994, Lo & Chen 1995 and Mayhew, Sanfelice, Teel 2011",
    attribution=ADAPTED,
    formula=r"u = -\tfrac{\lambda}{2}(\eta\,\omega + \epsilon \times \omega) - K(\omega - \lambda\,\epsilon),"
    r"\quad \eta \ge -\delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    is_beyond_the_paper=True,
    display=Display("sliding with memory", Look("orange", "d", "dashed"), "With memory", SLIDING),
)
