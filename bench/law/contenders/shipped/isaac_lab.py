"""The operational-space controller of Isaac Lab: axis times angle of either sign of the quaternion.

By default it cancels no inertia, in spite of its name; tasks may ask for it. Its source computes in single precision.
Read in the wheel of the release, isaaclab 2.3.2.post1.
"""

from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, logarithm

SHIPPED = as_shipped(
    "isaac-lab",
    "Isaac Lab, operational-space controller",
    "isaac-sim/IsaacLab@v2.3.2",
    "source/isaaclab/isaaclab/utils/math.py, source/isaaclab/isaaclab/controllers/operational_space.py",
    TORQUE,
    r"e = \log(R_d R^\top)",
    logarithm,
    100.0,
    2.0 * 100.0**0.5,
    "operational_space_cfg.py; damping ratio 1",
)
