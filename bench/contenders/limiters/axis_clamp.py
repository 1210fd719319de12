"""A bound on each component: what exceeds it is cut, the others stay, so that the command turns off its direction.

crisp_controllers cuts the error so with limit_error set. Near the goal it does nothing. Far from it the tool
turns about another axis than the shortest way's, by up to 54.7 degrees, the angle of a cube's diagonal to its edge; how
much depends on the base frame.

Fails: nowhere, but its way is longer.
"""

from bench.law import GREATEST_RATE, Limiter, kernel


@kernel
def cut(x):
    """x in [-GREATEST_RATE, GREATEST_RATE]."""
    if x > GREATEST_RATE:
        return GREATEST_RATE
    if x < -GREATEST_RATE:
        return -GREATEST_RATE
    return x


@kernel
def limit(omega, K):
    """Each component in [-GREATEST_RATE, GREATEST_RATE]."""
    return (cut(omega[0]), cut(omega[1]), cut(omega[2]))


LIMITER = Limiter(
    "axis-clamp",
    "Clamp per axis",
    "utiasDSL/crisp_controllers 5075de9, src/cartesian_controller.cpp",
    r"\max(-b, \min(b, \omega_i))",
    limit,
)
