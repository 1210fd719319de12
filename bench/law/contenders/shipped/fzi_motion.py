"""The motion controller of cartesian_controllers (FZI): KDL's axis and angle, the angle held within 1 rad.

The error times 0.5 drives a simulated arm whose last link has unit inertia; 10 % of its velocity is taken off at each
of its steps of 0.02 s, which is the damping here. Ten such steps are one tick of 10 ms: its seconds pass 20 times as
fast, so that in the robot's seconds the stiffness is 400 times and the damping 20 times what it simulates. Its source
turns the simulated joints; KDL takes angles below 1e-6 rad for none and loses digits near 180°.
"""

import math

from bench.law import kernel
from bench.law.kinds import POSITION
from bench.law.shipped import as_shipped, logarithm, shortened

LONGEST_RAD = 1.0
STEP_S, LEFT, FASTER = 0.02, 0.9, 20.0


@kernel
def error(q):
    """theta k with theta at most LONGEST_RAD."""
    return shortened(logarithm(q), LONGEST_RAD)


SHIPPED = as_shipped(
    "fzi-motion",
    "cartesian_controllers (FZI), motion controller",
    "fzi-forschungszentrum-informatik/cartesian_controllers@f53f798029ea5e05993e8a5d1736c713379af0e2",
    "cartesian_motion_controller/src/cartesian_motion_controller.cpp, cartesian_controller_base/src/"
    "ForwardDynamicsSolver.cpp, cartesian_controller_simulation/config/controller_manager.yaml",
    POSITION,
    r"e = \min(\theta, 1)\,k",
    error,
    0.5 * FASTER**2,
    -math.log(LEFT) / STEP_S * FASTER,
    "p 0.5 of controller_manager.yaml; 10 % of the velocity a step",
    shapes_inertia=True,
    unbounded=logarithm,
    bound=LONGEST_RAD,
    thread="orocos/orocos_kinematics_dynamics#352",
)
