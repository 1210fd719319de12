"""Modified Rodrigues parameters of the turn to the goal, on the sheet within 180°: e = 4 tan(theta/4) k.

Limitations: at 180° the command jumps to its opposite.
"""

from bench.law import PUBLISHED, QUARTER, Display, Law, Look, kernel, spring_damper, sqrt, turn_quaternion


@kernel
def turn_by_quarter(w, v, root, omega, gains):
    """4 Kp tan(theta/4) k - Kv omega of the turn with the quaternion (w, v) of length 2 root."""
    scale = 4.0 * gains.kp / (w + 2.0 * root)
    return spring_damper(scale, v, gains.kv, omega)


@kernel
def law(R, omega, goal, gains):
    """u = 4 Kp eps/(1 + eta) - Kv omega, (eta, eps) the unit quaternion of the turn from R to R_d, eta >= 0."""
    w, v, t = turn_quaternion(R, goal.R)
    return turn_by_quarter(w, v, sqrt(t), omega, gains)


REGULATOR = Law(
    name="mrp",
    title="Modified Rodrigues parameters (MRP)",
    source="Schaub & Junkins 2018; also Tsiotras 1996",
    attribution=PUBLISHED,
    formula=r"u = 4 K_p\,\sigma - K_v\,\omega, \quad \sigma = \tan(\theta/4)\,k",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    display=Display("MRP", Look("wine", "^", "solid"), "On three parameters", QUARTER),
)
