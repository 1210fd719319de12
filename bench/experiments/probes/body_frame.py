"""The law `sliding` with its sliding variable in the body frame: the second frame of Lopez and Slotine 2024.

With E = R_d R^T, its quaternion (eta, eps) and s = omega - lambda eps in the base frame, the same variable in the body
frame is s_body = R^T s. The law `sliding` makes s obey sdot = -K s. This law makes s_body obey the same equation.
Because d(R^T s)/dt = R^T (sdot - omega x s), its command is that of `sliding` plus omega x s = lambda eps x omega:

    u = -(lambda/2) (eta omega - eps x omega) - K (omega - lambda eps)

Source: derived here; the text of the paper gives the two frames (section 1).
"""

from typing import Any

from bench.law import kernel, sqrt, turn_quaternion
from bench.law.contenders.regulators import sliding


@kernel
def law_in_body_frame(R: Any, omega: Any, goal: Any, gains: Any) -> Any:
    """Return u [rad/s^2], base frame, for eta >= 0.

    With -eps and -omega, the command of `sliding` is -u: all its terms but eps x omega change their sign.
    """
    w, v, t = turn_quaternion(R, goal.R)
    opposite, back = (
        (-v[0], -v[1], -v[2]),
        (-omega[0], -omega[1], -omega[2]),
    )
    u = sliding.slide(w, opposite, sqrt(t), back, gains)
    return (-u[0], -u[1], -u[2])


IN_BODY_FRAME = sliding.REGULATOR._replace(
    name="sliding-in-body-frame", law=law_in_body_frame
)
"""Known to the probe `sliding-frames` alone: no suite runs it on its own."""
