"""The 1980 law's sine without a measured rate: a frame F that follows the body stands in for it.

With e = sin(theta) k of the turn from R to R_d and z the same of the turn from F to R, both in the base frame,

    u = Kp e - 2 Kv^2 z        F turns at gamma z, gamma = (3 sqrt(3)/2) Kv, and begins at the first orientation

so omega is never read, and |u| <= Kp + 2 Kv^2. Small angles obey s^3 + gamma s^2 + (Kp + 2 Kv^2) s + gamma Kp, which is
stable for all gains and (s + sqrt(3 Kp))^3 at Kv = 2 sqrt(Kp).

V = Kp (1 - cos theta) + 2 Kv^2 (1 - cos theta_F) + |omega|^2/2 has V' = -2 Kv^2 gamma |z|^2. Where theta_F is 180°, V
is at least 4 Kv^2, and a body may swing without damping. From rest V is at most 2 Kp: so almost global there if Kp <
2 Kv^2.

The state is the quaternion of F, of any length. Limitations: rests at exact 180° rotations; regulates only, a moving
goal's rate is not fed forward.

Source: Lizarralde, Wen 1996, Attitude control without angular velocity measurement (a filter makes up for the rate);
Tayebi 2008, Unit quaternion-based output feedback for the attitude tracking problem (a frame that follows); on vectors
Tayebi, Roberts, Benallegue 2013. The gains are this benchmark's.
"""

from bench.law import ADAPTED, Law, Stateful, double_sine, from_quaternion, kernel, quaternion_direction, sqrt

FOLLOWED = 1.5 * sqrt(3.0)
"""gamma over Kv: with 2 Kv^2 it makes the three poles one where Kv^2 = 4 Kp."""


@kernel
def begin(R):
    """Return the quaternion of R: the frame is where the body is."""
    quat_wxyz, _ = quaternion_direction(R)
    return quat_wxyz


@kernel
def law(R, omega, goal, gains, state):
    """u = Kp e - 2 Kv^2 z, and the quaternion's rate (0, gamma z) o q/2."""
    w, x, y, z = state
    shorter = 1.0 / sqrt(w * w + x * x + y * y + z * z)
    F = from_quaternion((shorter * w, shorter * x, shorter * y, shorter * z))
    e, behind = double_sine(R, goal.R), double_sine(F, R)  # twice e, twice z
    pull, brake = 0.5 * gains.kp, gains.kv * gains.kv
    u = (
        pull * e[0] - brake * behind[0],
        pull * e[1] - brake * behind[1],
        pull * e[2] - brake * behind[2],
    )
    quarter = 0.25 * FOLLOWED * gains.kv
    p, q, r = quarter * behind[0], quarter * behind[1], quarter * behind[2]
    rate = (
        -(p * x + q * y + r * z),
        p * w + q * z - r * y,
        q * w + r * x - p * z,
        r * w + p * y - q * x,
    )
    return u, rate


COMPENSATOR = Stateful(
    Law(
        name="velocity-free",
        title="Sine of the angle, no measured rate",
        source="after Lizarralde & Wen 1996 and Tayebi 2008; the gains are ours",
        attribution=ADAPTED,
        formula=r"u = K_p\,e(R, R_d) - 2 K_v^2\,e(R, F), \quad \dot F = \gamma\,[e(F, R)]_\times F",
        law=law,
        property="almost global from rest where Kp < 2 Kv^2",
    ),
    begin=begin,
    polynomial=lambda kp, kv: (FOLLOWED * kv, kp + 2.0 * kv * kv, FOLLOWED * kv * kp),
    measures_rate=False,
    rejects=False,
    bound=lambda kp, kv: kp + 2.0 * kv * kv,
)
