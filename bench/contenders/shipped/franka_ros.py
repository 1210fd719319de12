"""The Cartesian impedance example of franka_ros: the bare vector part of the error quaternion, without its factor 2.

The sign comes of the dot product of the two quaternions. Until 2018-12 (commit 1c3843a) it was the rotation vector.
"""

from bench.law.shipped import TORQUE, Shipped, vector_part

SHIPPED = Shipped(
    "franka-ros",
    "franka_ros, Cartesian impedance example",
    "frankaemika/franka_ros@c11f000c2737acc22ed8dfeff40555b2644a4294",
    "franka_example_controllers/src/cartesian_impedance_example_controller.cpp, cfg/compliance_param.cfg",
    TORQUE,
    r"e = \operatorname{sgn}(\eta)\,\epsilon",
    vector_part,
    10.0,
    2.0 * 10.0**0.5,
    "default of the parameter; 2√K",
    besides="filters its gains and goals, limits the rate of the torques",
)
