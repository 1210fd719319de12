"""Joshi, Kelkar and Wen's quaternion feedback: a spring that hardens where the quaternion's scalar part is small.

    u = 1/2 ((eta I + [eps]x) Gp + gamma (1 - eta) I) eps - Gr omega      Gp = 4 Kp I, gamma = HARDENING Gp, Gr = Kv I

With Gp a multiple of I, [eps]x Gp eps is zero, and u = 2 Kp (eta + HARDENING (1 - eta)) eps - Kv omega: 0 gives the
1980 law's sine, 1 the error quaternion's vector part, 2 the spring 2 (2 - cos(theta/2)) sin(theta/2), which is 4 at
180°. Its potential is Gp |eps|^2/2 + gamma (1 - eta)^2/2.

Source: Joshi, Kelkar, Wen 1995, which was not read: the formula is from a report on it, and HARDENING is ours. Theirs
takes the quaternion as it comes, and may turn the longer way; here eta >= 0, so that the law is adapted. The family is
not ranked by one HARDENING: `python -P -m bench.studies.constants` varies it.

Limitations: at 180° the command jumps to its opposite.
"""

from bench.law import ADAPTED, Display, Equation, Law, Look, cos, kernel, sin, spring_damper, sqrt, turn_quaternion

HARDENING = 2.0
"""gamma over Gp."""


@kernel
def law(R, omega, goal, gains):
    """u = 2 Kp (eta + HARDENING (1 - eta)) eps - Kv omega, (eta, eps) of the turn from R to R_d, eta >= 0."""
    w, v, t = turn_quaternion(R, goal.R)
    root = sqrt(t)
    eta = 0.5 * w / root
    pull = gains.kp * (eta + HARDENING * (1.0 - eta)) / root
    return spring_damper(pull, v, gains.kv, omega)


REGULATOR = Law(
    name="joshi-kelkar-wen",
    title="Hardening quaternion spring",
    source=(
        "after Joshi, Kelkar, Wen 1995 (we read a report about the paper, not the paper); gamma/Gp = 2 and "
        "the choice of the shorter way are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = \tfrac12 \bigl((\eta I + [\epsilon]_\times) G_p + \gamma (1 - \eta) I\bigr)\,\epsilon - G_r\,\omega",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    display=Display(
        "hardening spring",
        Look("orange", "s", "solid"),
        "On the quaternion",
        Equation(
            r"2\,(2 - \cos(\theta/2)) \sin(\theta/2)",
            lambda theta: 2.0 * (HARDENING - (HARDENING - 1.0) * cos(theta / 2.0)) * sin(theta / 2.0),
        ),
    ),
)
