"""The square-root law with one quaternion of memory: global, with no point of rest but the goal.

The error quaternion is followed from tick to tick, and its sign changed only where its scalar part has fallen below
-DELTA: near a half turn the law keeps to the way it has begun, so that no noise holds it there. No continuous law
without memory can do it (Bhat & Bernstein 2000).

Fails: nowhere known; within asin(DELTA) beyond a half turn it goes the longer way on.
"""

from bench.contender import Regulator
from bench.scalar import kernel, sqrt
from bench.so3 import turn_quaternion

DELTA = 0.4
"""Half the width of the hysteresis, in eta = cos(theta/2): 47 degrees beyond a half turn."""


@kernel
def law(R, omega, goal, gains, memory):
    """u = 2 Kp h eps - Kv omega; memory: the quaternion h (eta, eps) of the last tick, whose side is kept."""
    w, v, t = turn_quaternion(R, goal.R)
    scale = 0.5 / sqrt(t)
    kept = memory[0] * w + memory[1] * v[0] + memory[2] * v[1] + memory[3] * v[2]
    if kept < 0.0 and scale * w < DELTA:
        scale = -scale
    eta, eps = scale * w, (scale * v[0], scale * v[1], scale * v[2])
    double = 2.0 * gains.kp
    u = (
        double * eps[0] - gains.kv * omega[0],
        double * eps[1] - gains.kv * omega[1],
        double * eps[2] - gains.kv * omega[2],
    )
    return u, (eta, eps[0], eps[1], eps[2])


REGULATOR = Regulator(
    name="hybrid",
    title="Hybrid, with one quaternion of memory",
    source="Mayhew, Sanfelice, Teel 2011",
    formula=r"u = 2 K_p\, h\,\epsilon - K_v\,\omega, \quad h^+ = -h \text{ where } h\,\eta < -\delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    property="global with memory",
    later=True,
)
