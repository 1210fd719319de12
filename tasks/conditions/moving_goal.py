"""A goal oscillating about two axes, at a peak rate of the level; its rate and acceleration are feedforward."""

from tasks.axis import Axis, Field
from tasks.base import AT_REST
from tasks.moving_goal import RATE, RATE_AND_ACCELERATION, reference_column, reference_rates


def sway(level, R_0, time_s):
    """Return the columns, angular velocity and acceleration of the goal of tasks/moving_goal.py."""
    n = reference_column(time_s, level, R_0[0])
    o = reference_column(time_s, level, R_0[1])
    a = reference_column(time_s, level, R_0[2])
    omega_d, alpha_d = reference_rates(time_s, level)
    return (n, o, a), omega_d, alpha_d


def withhold(level, motion, now):
    """Return what the law is given: nothing, the rate, or the rate and the acceleration."""
    omega_d, alpha_d = motion
    if level < RATE:
        return AT_REST, AT_REST
    if level < RATE_AND_ACCELERATION:
        return omega_d, AT_REST
    return omega_d, alpha_d


AXIS = Axis(
    "moving-goal",
    "Moving goal, full feedforward",
    "rad/s",
    (0.0, 0.5, 1.0, 2.0, 5.0, 10.0),
    0.0,
    (
        Field(
            "reference_amplitude",
            0.0,
            "peak rate of a goal that moves [rad/s]",
            goal=sway,
            lasts=True,
        ),
        Field(
            "feedforward",
            RATE_AND_ACCELERATION,
            "what the law is given of the goal's motion",
            feedforward=withhold,
            lasts=False,
        ),
    ),
    sets=lambda level: {"reference_amplitude": level, "feedforward": RATE_AND_ACCELERATION},
)
