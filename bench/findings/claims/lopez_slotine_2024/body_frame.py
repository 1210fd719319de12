"""The law `sliding` with its sliding variable in the body frame: the second frame of Lopez and Slotine 2024.

With E = R_d R^T, its quaternion (eta, eps) and s = omega - lambda eps in the base frame, the same variable in the body
frame is s_body = R^T s. The law `sliding` makes s obey sdot = -K s. This law makes s_body obey d(s_body)/dt = -K s_body.
Because d(R^T s)/dt = R^T (sdot - omega x s), its command is that of `sliding` plus omega x s = lambda eps x omega.

Source: derived here; the text of the paper gives the two frames (section 1).
"""

from bench.law import cross, kernel, sqrt, turn_quaternion
from bench.law.contenders.regulators import sliding
from bench.law.kinds import Law


@kernel
def law_in_body_frame(R, omega, goal, gains):
    """Return u = u_sliding + lambda eps x omega [rad/s^2], base frame, for eta >= 0."""
    w, v, t = turn_quaternion(R, goal.R)
    root = sqrt(t)
    scale = 0.5 / root
    eps = (scale * v[0], scale * v[1], scale * v[2])
    half = 0.5 * gains.kv
    square = half * half - gains.kp
    apart = 0.0
    if square > 0.0:
        apart = sqrt(square)
    rate = 2.0 * (half - apart)
    swept = cross(eps, omega)
    u = sliding.slide(w, v, root, omega, gains)
    return (
        u[0] + rate * swept[0],
        u[1] + rate * swept[1],
        u[2] + rate * swept[2],
    )


IN_BODY_FRAME: Law = sliding.REGULATOR._replace(name="sliding-in-body-frame", law=law_in_body_frame)
"""Known to the claims alone: no suite runs it."""
