"""A goal that jumps.

Until a goal jumps (tasks/conditions/goal_jump.py) nothing is judged; there the row and the band begin again.
"""

import math

from bench.engines.episode import FIRST_METRIC
from bench.engines.ideal import angle_between
from bench.law.scalar import kernel
from tasks.rules import RULES, band_rad

NO_BAND = -1.0
"""Haversine of the band before the jump: nothing is inside it."""

TOLERANCE, FLOOR_RAD, AT_GOAL_RAD = RULES.tolerance, RULES.floor_rad, RULES.at_goal_rad


@kernel
def restart(row, start, body, sensed, tick):
    """At the jump, measure afresh; the band, and the row's last number, are of the angle to the goal that holds."""
    if tick == body.timing.jump:
        angle = angle_between(sensed.R, sensed.goal.R)
        half_sine = math.sin(0.5 * band_rad(angle, TOLERANCE, FLOOR_RAD, AT_GOAL_RAD))
        start[11] = half_sine * half_sine
        # Number by number: numba compiles the copy of a slice with the text of its errors, 2 s.
        for column in range(FIRST_METRIC, row.shape[0]):
            row[column] = body.fresh[column - FIRST_METRIC]
        row[row.shape[0] - 1] = angle
