"""The 1980 law's sine and a damper that never exceeds it: |u| <= 2 Kp at every orientation and every rate.

    u = Kp e - Kv omega/sqrt(1 + |omega|^2/w^2)      e = sin(theta) k,  w = Kp/Kv

Far above w the damper is Kp against the motion; far below it is Kv omega. With V = Kp (1 - cos theta) + |omega|^2/2,
V' = -Kv |omega|^2/sqrt(1 + |omega|^2/w^2): almost global, like the law without the bound. A motor of 2 Kp is never
saturated, whatever spin the law is switched on at.

Source: Su, Zheng 2011, Globally asymptotic stabilization of spacecraft with simple saturated proportional-derivative
control (there each component separately, and the quaternion's vector part).

Limitations: rests at exact 180° rotations; takes |omega|/Kp to stop a fast spin, where the damper alone would take
1/Kv.
"""

from bench.law import ADAPTED, SINE, Display, Equation, Law, Look, dot, double_sine, kernel, spring_damper, sqrt


@kernel
def law(R, omega, goal, gains):
    """u = Kp e - Kv omega/sqrt(1 + |omega|^2/w^2), w = Kp/Kv; all in the base frame."""
    slower = gains.kv / gains.kp
    damper = gains.kv / sqrt(1.0 + slower * slower * dot(omega, omega))
    return spring_damper(0.5 * gains.kp, double_sine(R, goal.R), damper, omega)


REGULATOR = Law(
    name="bounded-command",
    title="Bounded command, by the sine of the angle",
    source="after Su & Zheng 2011",
    attribution=ADAPTED,
    formula=r"u = K_p\,e - K_v\,\omega / \sqrt{1 + (K_v |\omega| / K_p)^2}",
    law=law,
    property="almost global",
    later=True,
    display=Display(
        "bounded command",
        Look("green", "h", "dotted"),
        "On the matrix",
        Equation(
            r"\sin\theta + K_v \dot\theta \bigl(1/\sqrt{1 + (K_v \dot\theta / K_p)^2} - 1\bigr)/K_p",
            SINE.spring,
            lambda theta, rate, kp, kv: kv * rate * (1.0 - 1.0 / sqrt(1.0 + (kv * rate / kp) * (kv * rate / kp))),
        ),
    ),
)
