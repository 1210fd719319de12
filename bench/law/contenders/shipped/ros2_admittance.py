"""The admittance controller of ros2_controllers: the logarithm, on a mass, damper and spring that it simulates.

It has no default gains: those here are of its own tests, about z. Stiffness and damping are in a frame that the user
names; with equal ones about all axes the frame has no effect. Its source also damps the joints and filters the wrench.
"""

from bench.law.kinds import POSITION
from bench.law.shipped import as_shipped, logarithm

INERTIA, STIFFNESS, DAMPING_RATIO = 10.1, 214.6, 2.828427

SHIPPED = as_shipped(
    "ros2-admittance",
    "ros2_controllers, admittance controller",
    "ros-controls/ros2_controllers@94e74de35f9d04f313aca8f29df66c3a76004aa7",
    "admittance_controller/include/admittance_controller/admittance_rule_impl.hpp, admittance_controller/"
    "test/test_params.yaml",
    POSITION,
    r"e = \log(R_d R^\top)",
    logarithm,
    STIFFNESS / INERTIA,
    2.0 * DAMPING_RATIO * (STIFFNESS / INERTIA) ** 0.5,
    "its tests' parameters, over their inertia; damping ratio 2.83",
    shapes_inertia=True,
)
