"""Sliding on omega = lambda eps: the error quaternion's vector part decays along a first-order path.

With the error quaternion (eta, eps) of the turn to the goal, depsdt = -(eta omega + eps x omega)/2; the law makes
z = omega - lambda eps obey zdot = -K z. Near the goal that is the double pole of the gains,
K = Kv/2 + d, lambda/2 = Kv/2 - d, d^2 = Kv^2/4 - Kp. Gains whose poles are not real leave no surface to slide on: then
d is taken for 0, and K lambda eps, which is 2 Kp eps, stays that.

Limitations: at 180° the command jumps to its opposite.
"""

from bench.law import CHORD, PUBLISHED, Display, Equation, Law, Look, cos, cross, kernel, sqrt, turn_quaternion


@kernel
def slide(w, v, root, omega, gains):
    """-(lambda/2)(eta omega + eps x omega) - K (omega - lambda eps), (eta, eps) = (w, v)/(2 root).

    Re-derived, see tests.
    """
    scale = 0.5 / root
    eta, eps = scale * w, (scale * v[0], scale * v[1], scale * v[2])
    half = 0.5 * gains.kv
    square = half * half - gains.kp
    apart = 0.0
    if square > 0.0:
        apart = sqrt(square)
    K, half_lambda = half + apart, half - apart
    swept = cross(eps, omega)
    spring, drag = 2.0 * gains.kp, half_lambda * eta + K
    return (
        spring * eps[0] - drag * omega[0] - half_lambda * swept[0],
        spring * eps[1] - drag * omega[1] - half_lambda * swept[1],
        spring * eps[2] - drag * omega[2] - half_lambda * swept[2],
    )


@kernel
def law(R, omega, goal, gains):
    """u = -(lambda/2)(eta omega + eps x omega) - K (omega - lambda eps), base frame, eta >= 0."""
    w, v, t = turn_quaternion(R, goal.R)
    return slide(w, v, sqrt(t), omega, gains)


def half_lambda(kp, kv):
    """Half the rate of the path [1/s], as the law above has it."""
    return kv / 2.0 - sqrt(max(0.0, kv * kv / 4.0 - kp))


SLIDING = Equation(
    r"2 \sin(\theta/2) - \lambda\,(1 - \cos(\theta/2))\,\dot\theta/(2 K_p)",
    CHORD.spring,
    lambda theta, rate, kp, kv: half_lambda(kp, kv) * (1.0 - cos(theta / 2.0)) * rate,
)

REGULATOR = Law(
    name="sliding",
    title="Sliding on the quaternion",
    source=(
        "Egeland & Godhavn 1994 (we derived the law again); lambda and K as functions of Kp and Kv are ours; "
        "also Lo & Chen 1995"
    ),
    attribution=PUBLISHED,
    formula=r"u = -\tfrac{\lambda}{2}(\eta\,\omega + \epsilon \times \omega) - K(\omega - \lambda\,\epsilon)",
    law=law,
    property="almost global",
    is_beyond_the_paper=True,
    display=Display("sliding", Look("orange", "v", "dash-dot"), "On the quaternion", SLIDING),
)
