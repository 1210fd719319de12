"""Paielli and Bach's law: the quaternion's vector part eps = sin(theta/2) k obeys a linear equation exactly.

With a fixed goal epsddot = -Kv epsdot - Kp eps; for it eps must be divided by eta: eps/eta = s/(1 + t).

From rest |eps| only shrinks, and the body reaches the goal. One that spins fast enough comes to 180° all the same.
Limitations: the command, 2 Kp tan(theta/2) at rest, grows without bound towards 180 degrees and is not finite there.
Starts that the maps count as lost exceed the judge's limit on the command: their share depends on that limit.
"""

from bench.law import (
    LINEAR_SINE,
    PUBLISHED,
    Display,
    Law,
    Look,
    dot,
    double_sine,
    half_cosine_squared,
    kernel,
    spring_damper,
    trace,
)


@kernel
def law(R, omega, goal, gains):
    """u = (2 Kp - |omega|^2/2) s/(1 + t) - Kv omega; re-derived, see tests."""
    s = double_sine(R, goal.R)
    scale = (2.0 * gains.kp - 0.5 * dot(omega, omega)) / (1.0 + trace(R, goal.R))
    return spring_damper(scale, s, gains.kv, omega)


REGULATOR = Law(
    name="paielli-bach",
    title="Paielli–Bach, linear in the quaternion",
    source="Paielli & Bach 1993 (we derived the law again)",
    attribution=PUBLISHED,
    formula=r"u = (2 K_p - \tfrac{1}{2}|\omega|^2)\, s/(1 + t) - K_v\,\omega",
    law=law,
    property="almost global from rest",
    margin=half_cosine_squared,
    is_beyond_the_paper=True,
    display=Display("Paielli–Bach", Look("yellow", "d", "solid"), "On the quaternion", LINEAR_SINE),
)
