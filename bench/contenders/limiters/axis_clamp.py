"""A bound on each component: what exceeds it is cut, the others stay, so that the command turns off its direction.

crisp_controllers cuts the error so, serl_franka too. Near the goal it does nothing; far from it the tool turns about
another axis than the shortest way's, by up to 54.7 degrees (all three components cut: towards the cube's corner), and
by how much depends on the base frame.

Fails: nowhere, but its way is longer.
"""

from bench.contenders.limiters.norm_clamp import BOUND
from bench.law import Limiter, kernel


@kernel
def cut(x):
    """x in [-BOUND, BOUND]."""
    if x > BOUND:
        return BOUND
    if x < -BOUND:
        return -BOUND
    return x


@kernel
def limit(omega, K):
    """Each component in [-BOUND, BOUND]."""
    return (cut(omega[0]), cut(omega[1]), cut(omega[2]))


LIMITER = Limiter(
    "axis-clamp",
    "Clamp per axis",
    "utiasDSL/crisp_controllers",
    r"\max(-b, \min(b, \omega_i))",
    limit,
)
