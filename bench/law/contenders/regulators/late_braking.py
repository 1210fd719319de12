"""Saturating spring, damping reduced while moving towards the goal, and a stored sign of the error quaternion.

With E = R_d R^T, the turn theta k from R to R_d in the base frame, t = tr E and eps = sin(theta/2) k,

    u = (Kp (5 + t)/4 + (4/5) Kv max(0, eps . omega)) eps - Kv omega

Spring: (5 + t)/4 = 1 + cos^2(theta/2), so f = (1 + cos^2(theta/2)) sin(theta/2), the 1980 law's sine at first. It is
never above (4/3) sqrt(2/3) = 1.09, and at 180°, where the sine is 0, it is 1. Damper: towards the goal it is
Kv (1 - (4/5) sin^2(theta/2)), a fifth of Kv at 180°; every other motion feels all of Kv. So a far body gains
speed, and brakes late.

Within 120 degrees (t >= 0) eps = s/(2 sqrt(1 + t)), s = 2 sin(theta) k off the diagonal of E. Beyond, eps
comes of the largest diagonal element of E (`so3.quaternion_direction`), with the sign that keeps it on the
side of the last tick. So a side changes 60 degrees past a 180° rotation and not before, and no error of
orientation under 60 degrees can change it back and forth, if e + phi/2 < 90 degrees for an error e and a turn
phi within a tick. The memory outlives the goal: reset it before the first tick and after a pause. When the
goal jumps, a reset shortens the way and saves no time.

Global: V = Kp U + |omega|^2/2 with U' = f has Vdot <= -(Kv/5) |omega|^2, and a change of side takes (13/6) Kp from it.
Limitations: up to 60 degrees beyond a 180° rotation it keeps turning the longer way, and so it may
without a reset when the goal jumps.
"""

from bench.law import OURS, Display, Equation, Law, Look, cos, dot, kernel, quaternion_direction, sin, sqrt, turn_matrix

EASED = 0.8
"""Share of the damper that is gone at 180°; under 1, so that it never pushes."""


@kernel
def law(R, omega, goal, gains, memory):
    """u = (Kp (5 + t)/4 + (4/5) Kv max(0, eps . omega)) eps - Kv omega; memory: the last (w, v).

    Here (eta, eps) = (w, v)/(2 sqrt(square)): three products fewer than if eps were formed.
    """
    E = turn_matrix(R, goal.R)
    t = E.n[0] + E.o[1] + E.a[2]
    if t < 0.0:
        (w, x, y, z), square = quaternion_direction(E)
        if memory[0] * w + memory[1] * x + memory[2] * y + memory[3] * z < 0.0:
            w, x, y, z = -w, -x, -y, -z
    else:
        square = 1.0 + t
        w, x, y, z = square, E.o[2] - E.a[1], E.a[0] - E.n[2], E.n[1] - E.o[0]
    v = (x, y, z)
    shorter = 1.0 / sqrt(square)
    pull = gains.kp * (0.625 + 0.125 * t)
    homeward = dot(v, omega)
    if homeward > 0.0:
        pull = pull + 0.25 * EASED * gains.kv * (shorter * homeward)
    scale = shorter * pull
    u = (
        scale * v[0] - gains.kv * omega[0],
        scale * v[1] - gains.kv * omega[1],
        scale * v[2] - gains.kv * omega[2],
    )
    return u, (w, x, y, z)


REGULATOR = Law(
    name="late-braking",
    title="Late braking",
    source="this benchmark, 2026; after Luh, Walker, Paul 1980 and Mayhew, Sanfelice, Teel 2011",
    attribution=OURS,
    formula=r"u = \bigl(\tfrac{5+t}{4} K_p + \tfrac45 K_v \max(0,\, \epsilon\cdot\omega)\bigr)\,\epsilon - K_v\,\omega",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    is_beyond_the_paper=True,
    display=Display(
        "late braking",
        Look("yellow", "D", "dash-dot"),
        "On the matrix",
        Equation(
            r"\bigl(1 + \cos^2(\theta/2)\bigr) \sin(\theta/2) - 4 K_v \sin^2(\theta/2)\, \min(0, \dot\theta)/(5 K_p)",
            lambda theta: (1.0 + cos(theta / 2.0) ** 2) * sin(theta / 2.0),
            lambda theta, rate, kp, kv: EASED * kv * sin(theta / 2.0) ** 2 * min(0.0, rate),
        ),
    ),
)
