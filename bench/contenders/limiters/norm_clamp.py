"""A bound on the speed: a longer command is shortened to it and keeps its direction, so that the path is the law's own.

FZI's Cartesian controllers do so with the error, at 1 rad, whatever the gain.

Fails: nowhere.
"""

from bench.law import GREATEST_RATE, Limiter, dot, kernel, sqrt


@kernel
def limit(omega, K):
    """min(1, GREATEST_RATE/|omega|) omega."""
    squared = dot(omega, omega)
    if squared > GREATEST_RATE * GREATEST_RATE:
        scale = GREATEST_RATE / sqrt(squared)
        return (scale * omega[0], scale * omega[1], scale * omega[2])
    return omega


LIMITER = Limiter(
    "norm-clamp",
    "Norm clamp",
    "fzi-forschungszentrum-informatik/cartesian_controllers 520baf4, computeMotionError",
    r"\omega\,\min(1, b/|\omega|)",
    limit,
)
