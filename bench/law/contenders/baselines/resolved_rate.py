"""Resolved rate by a velocity servo: qdot_d = J^-1 v, v = Kp/Kv (p_d - p, log(R_d R^T)), qddot = Kv (qdot_d - qdot).

What industrial arms offer (Whitney 1969), with an ideal inner loop: tau = D qddot + fg. It is (2.2) with the rotation
vector but for Jdot qdot, which nobody compensates; near the goal both are the same double pole. With Kv far above
Kp/Kv the tool follows v, and errors fall as exp(-Kp/Kv t).

Limitations: where J has no inverse, and at a 180° rotation, where the logarithm jumps.
"""

from bench.law import ADAPTED, Baseline, Law, kernel, twist
from bench.law.contenders.jacobians.geometric import fill
from bench.law.contenders.regulators.rotation_vector import law


@kernel
def assemble(chain, goal, p_d, gains, memory, J, a):
    """J, and a = Kv (v - J qdot)."""
    pdot, omega = twist(chain)
    u = law(chain.R, omega, goal, gains)
    fill(J, chain)
    for i in range(3):
        a[i] = gains.kp * (p_d[i] - chain.p[i]) - gains.kv * pdot[i]
        a[3 + i] = u[i]
    return u, memory


BASELINE = Baseline(
    Law(
        name="resolved-rate",
        title="Resolved rate",
        source="after Whitney 1969; the logarithm as the error and the ideal servo are ours",
        attribution=ADAPTED,
        formula=r"\ddot q = K_v \left(J^{-1} v - \dot q\right)",
        law=law,
    ),
    assemble=assemble,
)
