"""The rotation vector on the side whose predicted cost is less, the rate of turning counted.

A straight spring obeys thetaddot = -Kp theta - Kv thetadot about a fixed axis. Of that motion, from the angle
theta to go and the rate r towards the goal, the integral of theta^2 + (thetaddot/Kp)^2 over all time is
quadratic in both; for the two sides, theta and 2 pi - theta with opposite rates, it differs by (4 pi/Kp)
((theta - pi) S - r), with S = Kp/Kv + Kv/2. So a body that spins away from the goal faster than S (pi -
theta) goes on around. The side of the last tick is kept until the other is better by MARGIN, an angle. The
memory outlives the goal: reset it before the first tick and after a pause. When the goal jumps, a reset
shortens the way and saves no time.

Source: Goncalves, Bena, Matveev, Perez-Arancibia, arXiv:2403.07269, whose abstract was read: of two torques they take
the one whose cost, of control and attitude error, a model predicts to be less. The cost in closed form, the spring and
MARGIN are ours, so that the law is a law of this benchmark.

Proved: local. About one fixed axis the prediction is exact and the cost falls, so that it is global there.
Limitations: from rest up to MARGIN, 46 degrees, beyond a 180° rotation it keeps turning the longer way; where omega is
not along the axis the prediction is not exact; a spinning body may pass the goal once.
"""

from bench.law import ANGLE, OURS, Display, Law, Look, acos, atan2, dot, kernel, spring_damper, sqrt, turn_on_kept_side

PI = acos(-1.0)
MARGIN = 0.8
"""Angle [rad] by which the other side must be better: at rest the side changes so far beyond 180°."""


@kernel
def law(R, omega, goal, gains, memory):
    """u = Kp theta k - Kv omega on the side that is kept; memory: the quaternion (w, v) of the last tick."""
    w, v, _ = turn_on_kept_side(R, goal.R, memory, 1.0)
    size = sqrt(dot(v, v))
    pull = 0.0
    if size > 0.0:
        theta = 2.0 * atan2(size, w)
        slope = gains.kp / gains.kv + 0.5 * gains.kv
        if theta - PI - dot(v, omega) / (size * slope) > MARGIN:
            theta = 2.0 * PI - theta
            w, v = -w, (-v[0], -v[1], -v[2])
        pull = gains.kp * theta / size
    return spring_damper(pull, v, gains.kv, omega), (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="predicted-side",
    title="Predicted side of the rotation vector",
    source=(
        "this benchmark, 2026; after Goncalves, Bena, Matveev, Perez-Arancibia, "
        "arXiv:2403.07269 (we read the abstract)"
    ),
    attribution=OURS,
    formula=r"u = K_p\,\theta\,k - K_v\,\omega, \quad k^+ = -k \text{ where } \theta - \pi -"
    r" \frac{k \cdot \omega}{K_p/K_v + K_v/2} > \delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    later=True,
    display=Display("predicted side", Look("purple", "P", "dotted"), "With memory", ANGLE),
)
