"""Rodrigues parameters (the Gibbs vector) of the turn to the goal: e = 2 tan(theta/2) k = 2 s/(1 + t), one division.

Limitations: the command, 2 Kp tan(theta/2), grows without bound towards 180 degrees and is not finite there.
Starts that the maps count as lost exceed the judge's limit on the command: their share depends on that limit.
"""

from bench.law import (
    PUBLISHED,
    TANGENT,
    Display,
    Law,
    Look,
    double_sine,
    half_cosine_squared,
    kernel,
    spring_damper,
    trace,
)


@kernel
def law(R, omega, goal, gains):
    """u = 2 Kp s/(1 + t) - Kv omega, s = n x n_d + o x o_d + a x a_d, t = tr(R_d^T R)."""
    s = double_sine(R, goal.R)
    scale = 2.0 * gains.kp / (1.0 + trace(R, goal.R))
    return spring_damper(scale, s, gains.kv, omega)


REGULATOR = Law(
    name="gibbs",
    title="Rodrigues parameters (Gibbs)",
    source="Tsiotras 1996; parameters: Rodrigues 1840",
    attribution=PUBLISHED,
    formula=r"u = 2 K_p\, s/(1 + t) - K_v\,\omega",
    law=law,
    property="almost global",
    margin=half_cosine_squared,
    is_beyond_the_paper=True,
    display=Display("Gibbs", Look("green", "s", "dashed"), "On three parameters", TANGENT),
)
