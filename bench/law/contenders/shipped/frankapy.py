"""The Cartesian impedance of frankapy: axis times angle by Eigen, the default of its `goto_pose` on real Pandas.

The controller is franka-interface's; K = 50 N m/rad is of iamlab-cmu/frankapy@4ba2872d, frankapy/franka_constants.py,
where it has been since the first public commit of 2020. Its source also interpolates the goal with minimum jerk; the
law here does not.
"""

from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, logarithm

SHIPPED = as_shipped(
    "frankapy",
    "frankapy, franka-interface's Cartesian impedance",
    "iamlab-cmu/franka-interface@c18b96e6b3b65d376ca33021559c26c50a9d8ba5",
    "franka-interface/src/feedback_controller/cartesian_impedance_feedback_controller.cpp",
    TORQUE,
    r"e = \log(R_d R^\top)",
    logarithm,
    50.0,
    2.0 * 50.0**0.5,
    "franka_constants.py of frankapy; 2√K",
)
