"""A bound on the speed: a longer command is shortened to it and keeps its direction, so that the path is the law's own.

FZI's controllers do so with the error, at 1 rad, and Cartesian velocity interfaces with the command.

Fails: nowhere.
"""

from bench.law import Limiter, dot, kernel, sqrt

BOUND = 2.0
"""[rad/s]. Robot arms turn their tools at 1 to 3 rad/s; half a turn takes 1.6 s and a bit."""


@kernel
def limit(omega, K):
    """min(1, BOUND/|omega|) omega."""
    squared = dot(omega, omega)
    if squared > BOUND * BOUND:
        scale = BOUND / sqrt(squared)
        return (scale * omega[0], scale * omega[1], scale * omega[2])
    return omega


LIMITER = Limiter(
    "norm-clamp",
    "Norm clamp",
    "fzi-forschungszentrum-informatik/cartesian_controllers",
    r"\omega\,\min(1, b/|\omega|)",
    limit,
)
