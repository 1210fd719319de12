"""Operational-space control of mjctrl: the logarithm by MuJoCo's quaternion to velocity, times 0.95.

The factor is the gain of a twist, and a constant of this demonstration; the stiffness multiplies the product. Its
source also bounds the torques by the actuators' ranges.
"""

from bench.law import kernel
from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, logarithm

TWIST_GAIN = 0.95


@kernel
def error(q):
    """TWIST_GAIN log(R_d R^T)."""
    e = logarithm(q)
    return (TWIST_GAIN * e[0], TWIST_GAIN * e[1], TWIST_GAIN * e[2])


SHIPPED = as_shipped(
    "mjctrl-opspace",
    "mjctrl, opspace.py",
    "kevinzakka/mjctrl@f1c82c257248e2e52b0e6c1beaf23c6a2026e4f2",
    "opspace.py",
    TORQUE,
    r"e = 0.95 \log(R_d R^\top)",
    error,
    50.0,
    2.0 * 50.0**0.5,
    "in the source; 2√K",
    shapes_inertia=True,
)
