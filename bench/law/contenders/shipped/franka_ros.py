"""The Cartesian impedance example of franka_ros: the vector part of the error quaternion, without its factor 2.

The sign comes from the dot product of the two quaternions. Until 2018-11-26 (commit 3e8e1aa) the error was the rotation
vector; commit 1c3843a of 2018-12-13 changed its frame alone. Its source also filters gains and goals, and limits the
change of a torque; the law here does not.
"""

from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, vector_part

SHIPPED = as_shipped(
    "franka-ros",
    "franka_ros, Cartesian impedance example",
    "frankaemika/franka_ros@c11f000c2737acc22ed8dfeff40555b2644a4294",
    "franka_example_controllers/src/cartesian_impedance_example_controller.cpp, franka_example_controllers/"
    "cfg/compliance_param.cfg",
    TORQUE,
    r"e = \operatorname{sgn}(\eta)\,\epsilon",
    vector_part,
    10.0,
    2.0 * 10.0**0.5,
    "default of the parameter; 2√K",
)
