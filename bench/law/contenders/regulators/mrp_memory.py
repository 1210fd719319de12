"""Modified Rodrigues parameters of the turn to the goal, their sheet kept in memory: e = 4 tan(theta/4) k.

The spring of `mrp`, on the quaternion that `bench.law.side` keeps: two published parts, put together here.
The memory outlives the goal: reset it before the first tick and after a pause. When the goal jumps, a reset
shortens the way and saves no time.

Global: V = 8 Kp ln(1 + tan^2(theta/4)) + |omega|^2/2 has Vdot = -Kv |omega|^2, the force is zero at the goal alone, and
a change of side takes theta from 2 acos(-DELTA) to 2 acos(DELTA), 133 degrees, and so takes from V.

Source: the spring is that of Schaub, Junkins 2018 and Tsiotras 1996, the kept side that of Mayhew, Sanfelice, Teel
2011. The nearest work is Martins, Cardeira, Oliveira, arXiv:2302.01983: a hybrid memory that lifts the attitude to
modified Rodrigues parameters, which stay within a hysteresis about the unit sphere. Of its text only the opening could
be had: whether it is the same law cannot be said.

Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way, and so it may without a reset when the goal jumps.
"""

from bench.law import ADAPTED, DELTA, QUARTER, Display, Law, Look, kernel, turn_on_kept_side
from bench.law.contenders.regulators.mrp import turn_by_quarter


@kernel
def law(R, omega, goal, gains, memory):
    """u = 4 Kp eps/(1 + eta) - Kv omega, (eta, eps) on the kept side; memory: the quaternion of the last tick."""
    w, v, root = turn_on_kept_side(R, goal.R, memory, DELTA)
    return turn_by_quarter(w, v, root, omega, gains), (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="mrp-memory",
    title="MRP with memory",
    source=(
        "after Schaub & Junkins 2018 and Mayhew, Sanfelice, Teel 2011; most similar work: "
        "Martins, Cardeira, Oliveira, arXiv:2302.01983 (we read its beginning)"
    ),
    attribution=ADAPTED,
    formula=r"u = 4 K_p\,\sigma - K_v\,\omega, \quad |\sigma|^2 \le (1+\delta)/(1-\delta)",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    is_beyond_the_paper=True,
    display=Display("MRP with memory", Look("violet", "X", "dashed"), "With memory", QUARTER),
)
