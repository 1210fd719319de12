"""Goals that move: where a swaying one is, what a law is given of its motion, and one that jumps.

Until a goal jumps (tasks/conditions/goal_jump.py) nothing is judged; there the row and the band begin again.
"""

import math

from bench.engines.episode import FIRST_METRIC
from bench.engines.ideal import angle_between
from bench.law.inputs import AT_REST
from bench.law.scalar import kernel
from bench.law.so3 import Rotation
from tasks.moving_goal import RATE, RATE_AND_ACCELERATION, reference_column, reference_rates
from tasks.rules import RULES, band_rad

NO_BAND = -1.0
"""Haversine of the band before the jump: nothing is inside it."""

TOLERANCE, FLOOR_RAD, AT_GOAL_RAD = RULES.tolerance, RULES.floor_rad, RULES.at_goal_rad


@kernel
def goal_at(R_0, time, amplitude):
    """Return (R_d, omega_d, alpha_d) at a time."""
    if amplitude > 0.0:
        R_d = Rotation(
            reference_column(time, amplitude, R_0.n),
            reference_column(time, amplitude, R_0.o),
            reference_column(time, amplitude, R_0.a),
        )
        omega_d, alpha_d = reference_rates(time, amplitude)
        return R_d, omega_d, alpha_d
    return R_0, AT_REST, AT_REST


@kernel
def fed_forward(omega_d, alpha_d, feedforward):
    """Return what the law is given of the goal's motion."""
    if feedforward < RATE:
        return AT_REST, AT_REST
    if feedforward < RATE_AND_ACCELERATION:
        return omega_d, AT_REST
    return omega_d, alpha_d


@kernel
def restart(row, start, body, sensed, tick):
    """At the jump, measure afresh; the band, and the row's last number, are of the angle to the goal that holds."""
    if tick == body.timing.jump:
        angle = angle_between(sensed.R, sensed.goal.R)
        start[11] = math.sin(0.5 * band_rad(angle, TOLERANCE, FLOOR_RAD, AT_GOAL_RAD)) ** 2
        row[FIRST_METRIC:] = body.fresh
        row[row.shape[0] - 1] = angle
