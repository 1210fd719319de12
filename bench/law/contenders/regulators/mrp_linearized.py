"""Feedback linearization in the modified Rodrigues parameters of the turn to the goal: no trigonometry, no pole.

With sigma = tan(theta/4) k of the turn from R to a fixed R_d, sigmaddot = -Kv sigmadot - Kp sigma. Beyond
180° the shadow set, -sigma/|sigma|^2, is the shorter; a sheet is kept until |sigma|^2 is over SWITCH, so that
the law does not chatter there. The memory outlives the goal: reset it before the first tick and after a
pause. When the goal jumps, a reset shortens the way and saves no time.

Source: Schaub, Akella, Junkins 2001. That a sheet is kept until SWITCH is ours.

Limitations: where the sheet changes the command jumps; a goal that jumps without a reset may be
reached the longer way.
"""

from bench.law import LINEAR_MRP, PUBLISHED, Display, Law, Look, dot, kernel, turn_on_kept_side

SWITCH = 1.5
"""|sigma|^2 at which the sheet changes, ours: 23 degrees beyond 180°, where it is 1."""
DELTA = (SWITCH - 1.0) / (SWITCH + 1.0)
"""-eta there, for sigma^2 = (1 - eta)/(1 + eta)."""


@kernel
def law(R, omega, goal, gains, memory):
    """u = -Kv omega + (4 Kp/(1 + sigma^2) - |omega|^2/2) sigma + omega (omega . sigma); memory: the last quaternion.

    Re-derived from sigmadot = -((1 - sigma^2) I + 2 [sigma]x + 2 sigma sigma^T) omega / 4, base frame; see tests.
    Here sigma = v/(w + 2 root) and 1 + sigma^2 = 4 root/(w + 2 root).
    """
    w, v, root = turn_on_kept_side(R, goal.R, memory, DELTA)
    down = 1.0 / (w + (root + root))
    spring = gains.kp / root - 0.5 * down * dot(omega, omega)
    along = down * dot(omega, v) - gains.kv
    u = (
        spring * v[0] + along * omega[0],
        spring * v[1] + along * omega[1],
        spring * v[2] + along * omega[2],
    )
    return u, (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="mrp-linearized",
    title="MRP made linear",
    source=(
        "Schaub, Akella, Junkins 2001; the stored choice of the MRP vector and its switch at "
        "|sigma|^2 = 1.5 are ours"
    ),
    attribution=PUBLISHED,
    formula=r"u = -K_v\,\omega + \bigl(4 K_p/(1+\sigma^2) - \omega^2/2\bigr)\,\sigma + \omega\,(\omega\cdot\sigma)",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    is_beyond_the_paper=True,
    display=Display("MRP made linear", Look("purple", "v", "dash-dot"), "On three parameters", LINEAR_MRP),
)
