"""Differential inverse kinematics of mjctrl: MuJoCo's quaternion to velocity, all of it in a tick, as positions.

The joints' position servos are between the command and the body; the law here has none.
"""

from bench.law.kinds import VELOCITY
from bench.law.shipped import as_shipped, logarithm

SHIPPED = as_shipped(
    "mjctrl-diffik",
    "mjctrl, diffik.py",
    "kevinzakka/mjctrl@f1c82c257248e2e52b0e6c1beaf23c6a2026e4f2",
    "diffik.py",
    VELOCITY,
    r"e = \log(R_d R^\top)",
    logarithm,
    1.0,
    0.0,
    "all of it in a tick",
)
