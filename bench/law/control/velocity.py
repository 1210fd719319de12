"""First-order laws, for robots commanded by velocities: omega = K f(R, R_d).

f is the error vector of a law u = Kp f - Kv omega: its command at omega = 0 over Kp. So every law whose command at rest
depends on nothing but R and R_d is a velocity law too. On an arm J qdot = (K (p_d - p), omega): resolved rate (Whitney
1969), by any inverse; a robot commanded by velocities has no inertia to its controller, so that what an inverse is
given for D is the identity.

Near the goal f = theta k, and each tick takes K dt of the angle: held commands are stable up to K dt = 2 / f'(0).

Source: Prabhu, Saxena, Sastry, arXiv:2004.00239 (the logarithm on SO(n), in continuous time).
"""

from bench.law.contender import Contender
from bench.law.kinds import ACTUATOR, COSTING
from bench.law.scalar import kernel


@kernel
def velocity(limit, u, K, kp):
    """(K u/Kp, the same limited) [rad/s, base frame]; u: the law's command at omega = 0."""
    scale = K / kp
    asked = (scale * u[0], scale * u[1], scale * u[2])
    return asked, limit(asked, K)


def is_velocity_law(one: Contender) -> bool:
    """Whether a law's command at rest is a function of R and R_d, or of a side kept beside them (its equation says)."""
    law = one.regulator
    return law.role not in (ACTUATOR, COSTING) and (law.memory is None or one.equation is not None)
