"""The error quaternion (eta, eps), the short way round: e = 2 sgn(eta) eps = 2 sin(theta/2) k.

Fails: nowhere; at a half turn the command jumps to its opposite. sgn(0) is 1 here: a law that takes it for 0 rests
there for ever.
"""

from bench.law import CHORD, Look, Regulator, kernel, sqrt, turn_quaternion


@kernel
def law(R, omega, goal, gains):
    """u = 2 Kp sgn(eta) eps - Kv omega, (eta, eps) the unit quaternion of the turn from R to R_d, base frame."""
    _, eps, t = turn_quaternion(R, goal.R)
    scale = gains.kp / sqrt(t)
    return (
        scale * eps[0] - gains.kv * omega[0],
        scale * eps[1] - gains.kv * omega[1],
        scale * eps[2] - gains.kv * omega[2],
    )


REGULATOR = Regulator(
    name="quaternion-shortest",
    title="Quaternion, the short way",
    source="Yuan 1988; Wie, Weiss, Arapostathis 1989",
    formula=r"u = 2 K_p\,\operatorname{sgn}(\eta)\,\epsilon - K_v\,\omega",
    law=law,
    property="almost global",
    later=True,
    short="shortest quaternion",
    look=Look("purple", "o", "solid"),
    family="On the quaternion",
    equation=CHORD,
)
