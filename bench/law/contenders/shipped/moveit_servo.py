"""Pose tracking of MoveIt Servo: axis and angle over a tick of 10 ms, at most 0.8 rad/s, along the great circle.

Its source also slows down near singularities and joint limits, and smooths; the law here does not.
"""

from bench.law import kernel
from bench.law.kinds import VELOCITY
from bench.law.shipped import as_shipped, logarithm, shortened

FASTEST, PERIOD_S = 0.8, 0.01
"""[rad/s], [s]."""


@kernel
def error(q):
    """theta k with theta at most FASTEST PERIOD_S: the goal is moved nearer by slerp."""
    return shortened(logarithm(q), FASTEST * PERIOD_S)


SHIPPED = as_shipped(
    "moveit-servo",
    "MoveIt Servo, pose tracking",
    "moveit/moveit2@8fcb5d2327767af3c764b1348a69a9b74c5efd18",
    "moveit_ros/moveit_servo/src/utils/command.cpp, moveit_ros/moveit_servo/config/servo_parameters.yaml",
    VELOCITY,
    r"e = \min(\theta,\, 0.008)\,k",
    error,
    1.0,
    0.0,
    "all of it in a tick, at most 0.8 rad/s",
    unbounded=logarithm,
    bound=FASTEST * PERIOD_S,
)
