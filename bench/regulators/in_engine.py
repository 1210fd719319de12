"""MuJoCo's <orientation> actuator: what a user of the simulator gets who writes no law, a servo along the geodesic.

It is run in MuJoCo, in place of our motors, with the goal as its control; the rotation vector's law is what it
computes, to rounding. Within 1e-15 rad of a half turn rounding chooses the side, and at exactly a half turn q and -q,
one attitude, are pushed opposite ways.

Fails: nowhere; at a half turn the command jumps to its opposite.
"""

from bench.contender import Regulator
from bench.regulators.rotation_vector import law as pull
from bench.scalar import kernel


@kernel
def law(R, omega, goal, gains):
    """u = Kp log(R_d R^T) - Kv omega: the formula of the actuator. Its cost is ours, MuJoCo's own is not counted."""
    return pull(R, omega, goal, gains)


REGULATOR = Regulator(
    name="in-engine",
    title="MuJoCo's orientation actuator",
    source="MuJoCo documentation, XML reference, actuator/orientation (3.11)",
    formula=r"u = K_p \log(R_d R^\top) - K_v\,\omega",
    law=law,
    property="almost global",
    later=True,
    in_engine=True,
)
