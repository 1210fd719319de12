"""Synergistic hybrid: two potentials that are at rest at different places, and a memory of which is in force.

With V = 1/2 (k_1 (1 - n.n_d) + k_2 (1 - o.o_d) + k_3 (1 - a.a_d)), k = WEIGHTS, and s its pull, the body is
seen as turned further about its own axis b = R AXIS by q KAPPA V, q = 1 or -1: U_q = V of the turned body
R_q. Both U_q have the goal for a minimum. Where one is at rest elsewhere, near a 180° rotation about n_d, o_d
or a_d, the other is lower by 0.16 at least, and q changes where it is lower by GAP: no other point of rest is
left. U_+ - U_- = -2 sin(KAPPA V) b.s: to compare them takes no second potential. The pull is of 2 TOP (1 -
sqrt(1 - U_q/TOP)), which grows like the distance: that of V itself fades towards a 180° rotation. The memory
outlives the goal: reset it before the first tick and after a pause. When the goal jumps, a reset shortens the
way and saves no time.

Global: the potential in force and |omega|^2/2 fall together as -Kv |omega|^2, a change of q takes GAP Kp or more from
them, and KAPPA |s| < 1 keeps the turned body from resting anywhere else.

Sources: Mayhew & Teel 2013, not read; Berkane & Tayebi, arXiv:1502.07386 and (with Abdessameud) 1510.03878, and Wang &
Tayebi, arXiv:2012.12470, whose abstracts were read. The formulas and all constants are derived here, so that nothing
of its speed says how fast theirs are: `python -P -m bench.studies.constants` varies KAPPA and GAP. The angle of Wang
& Tayebi is a state that flows and jumps; a law's memory has no period to let it flow. Held between jumps it cannot
serve: a weight on the angle that makes it return to 0 near the goal keeps it at 0 on 180° rotations. So the angle is
KAPPA V, as in angular warping, and its sign is remembered.

Limitations: the turn is curved, and longer than about one axis; stiffness depends on the axis.
"""

from bench.law import ADAPTED, Display, Law, Look, Rotation, cos, cross, dot, kernel, rotate, sin, sqrt
from bench.law.contenders.regulators.weighted_columns import WEIGHTS, pull_columns

SHARE = 2.0 / (1.0 / WEIGHTS[0] + 1.0 / WEIGHTS[1] + 1.0 / WEIGHTS[2])
AXIS = (sqrt(1.0 - SHARE / WEIGHTS[0]), sqrt(1.0 - SHARE / WEIGHTS[1]), sqrt(1.0 - SHARE / WEIGHTS[2]))
"""Unit vector, body frame: with it a small further turn lowers V equally at the three 180° rotations."""
KAPPA = 0.3
"""Further turn over V [rad]; |s| is 1.1 at most. The more, the greater the gap, and the slower the turn."""
GAP = 0.08
"""Difference U_q - U_-q at which q changes: half of the least where one is at rest."""
TOP = 2.4
"""V is 2.2 at most, at the 180° rotation about n_d."""


@kernel
def turn_column(c, b, angle_cos, angle_sin, along):
    """Rotate a unit vector c about b, with c.b = along."""
    d, rest = cross(b, c), (1.0 - angle_cos) * along
    return (
        angle_cos * c[0] + angle_sin * d[0] + rest * b[0],
        angle_cos * c[1] + angle_sin * d[1] + rest * b[1],
        angle_cos * c[2] + angle_sin * d[2] + rest * b[2],
    )


@kernel
def energy(R, R_d, k_1, k_2, k_3):
    """k_1 (1 - n.n_d) + k_2 (1 - o.o_d) + k_3 (1 - a.a_d)."""
    return k_1 * (1.0 - dot(R.n, R_d.n)) + k_2 * (1.0 - dot(R.o, R_d.o)) + k_3 * (1.0 - dot(R.a, R_d.a))


@kernel
def law(R, omega, goal, gains, memory):
    """u = Kp (s_q - q KAPPA (b.s_q) s)/sqrt(1 - U_q/TOP) - Kv omega, s_q the pull at R_q; memory: q, then zeros.

    At rest u is -Kp times the gradient of the potential in force, the further turn a function of R: see tests.
    """
    R_d, k_1, k_2, k_3 = goal.R, 0.5 * WEIGHTS[0], 0.5 * WEIGHTS[1], 0.5 * WEIGHTS[2]
    s, b = pull_columns(R, R_d, k_1, k_2, k_3), rotate(R, AXIS)
    angle = KAPPA * energy(R, R_d, k_1, k_2, k_3)
    q = 1.0
    if memory[0] < 0.0:
        q = -1.0
    if 2.0 * q * sin(angle) * dot(b, s) < -GAP:
        q = -q
    c, d = cos(angle), q * sin(angle)
    turned = Rotation(
        turn_column(R.n, b, c, d, AXIS[0]), turn_column(R.o, b, c, d, AXIS[1]), turn_column(R.a, b, c, d, AXIS[2])
    )
    e = pull_columns(turned, R_d, k_1, k_2, k_3)
    back = q * KAPPA * dot(b, e)
    pull = gains.kp / sqrt(1.0 - energy(turned, R_d, k_1, k_2, k_3) / TOP)
    u = (
        pull * (e[0] - back * s[0]) - gains.kv * omega[0],
        pull * (e[1] - back * s[1]) - gains.kv * omega[1],
        pull * (e[2] - back * s[2]) - gains.kv * omega[2],
    )
    return u, (q, 0.0, 0.0, 0.0)


REGULATOR = Law(
    name="synergistic",
    title="Synergistic hybrid, two potentials",
    source=(
        "after Berkane & Tayebi, arXiv:1502.07386, and Wang & Tayebi, arXiv:2012.12470 "
        "(we read the abstracts); potentials and constants are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = K_p\,\bigl(s_q - q\,\kappa\,(b \cdot s_q)\,s\bigr)/\sqrt{1 - U_q/U_0} - K_v\,\omega, \quad q^+ = -q"
    r" \text{ where } U_q - U_{-q} > \delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    stiffness=(1.1, 1.0, 0.9),
    is_beyond_the_paper=True,
    display=Display("synergistic", Look("green", "D", "dashed"), "With memory"),
)
