"""The 1980 law's sine with an integral that ends at the disturbance: no error is left of a constant one.

With e = sin(theta) k of the turn from R to R_d in the base frame and a constant disturbance d of the acceleration,

    u = Kp e - Kv omega - (Kp/3) x        x' = omega - c e, c = (4/9) Kv        x from zero

Small angles obey s^3 + Kv s^2 + (4/3) Kp s + (4/27) Kp Kv, which is stable for all gains and (s + Kv/3)^3 at
Kv = 2 sqrt(Kp). There a disturbance alone turns the body by d t^2/2 exp(-Kv t/3).

V = Kp (1 - cos theta) - c e . omega + |omega|^2/2 + (Kp/6) |x - 3 d/Kp|^2 is positive and never rises where
Kv^2 < 5 Kp: V' <= -((Kv - c) |omega|^2 - c Kv |e| |omega| + c Kp |e|^2). So almost global there.

The state is x, and a zero. Limitations: rests at exact 180° rotations without a disturbance; overshoots from rest, by
the integral of the way it has come.

Source: Goodarzi, Lee, Lee 2013, Geometric nonlinear PID control of a quadrotor UAV on SE(3) (the integral of
omega + c e_R). The gains are this benchmark's.
"""

from bench.law import ADAPTED, Law, Stateful, double_sine, kernel

INTEGRAL, LEAD = 1.0 / 3.0, 4.0 / 9.0
"""Integral gain over Kp, c over Kv: they make the three poles one where Kv^2 = 4 Kp."""


@kernel
def begin(R):
    """Nothing is known of the disturbance."""
    return (0.0, 0.0, 0.0, 0.0)


@kernel
def law(R, omega, goal, gains, state):
    """u = Kp e - Kv omega - (Kp/3) x, and x' = omega - c e."""
    e = double_sine(R, goal.R)  # twice e
    pull, hold, lead = 0.5 * gains.kp, INTEGRAL * gains.kp, 0.5 * LEAD * gains.kv
    u = (
        pull * e[0] - gains.kv * omega[0] - hold * state[0],
        pull * e[1] - gains.kv * omega[1] - hold * state[1],
        pull * e[2] - gains.kv * omega[2] - hold * state[2],
    )
    return u, (omega[0] - lead * e[0], omega[1] - lead * e[1], omega[2] - lead * e[2], 0.0)


COMPENSATOR = Stateful(
    Law(
        name="integral",
        title="Sine of the angle, with an integral",
        source="after Goodarzi, Lee & Lee 2013; the base frame of the integral and the gains are ours",
        attribution=ADAPTED,
        formula=r"u = K_p\,e - K_v\,\omega - \tfrac13 K_p x, \quad \dot x = \omega - \tfrac49 K_v\,e",
        law=law,
        property="almost global where Kv^2 < 5 Kp",
    ),
    begin=begin,
    polynomial=lambda kp, kv: (kv, (1.0 + INTEGRAL) * kp, INTEGRAL * LEAD * kp * kv),
    measures_rate=True,
    rejects=True,
)
