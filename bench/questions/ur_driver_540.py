"""Quaternions interpolated by component, of signs as they come, take an arm the long way round."""

import numpy as np

from bench.questions.question import Curves, Question
from tasks.goal_stream import componentwise, continued, normalized, slerp
from tasks.rotations import about
from tasks.truth import angle

AXIS, TURN = (0.0, 1.0, 0.0), np.radians(60.0)
SHARES = np.linspace(0.0, 1.0, 200, endpoint=False)[:, None]


def curves() -> Curves:
    """Angle to the orientation at the same share of the shortest way [deg]."""
    q = np.array([about(AXIS, 0.0), [-one for one in about(AXIS, TURN)]])
    made = normalized(componentwise(q, SHARES)), slerp(continued(q), SHARES)
    way = [about(AXIS, share * TURN) for share in SHARES[:, 0]]
    off = [[np.degrees(angle(one, right)) for one, right in zip(each.tolist(), way, strict=True)] for each in made]
    return Curves(SHARES[:, 0], np.array(off[0]), np.array(off[1]))


QUESTION = Question(
    "ur-driver-540",
    "The arm flips between two waypoints",
    (
        "UniversalRobots/Universal_Robots_ROS_Driver#540",
        "UniversalRobots/Universal_Robots_ROS_controllers_cartesian#14",
    ),
    "A Cartesian trajectory controller swings the arm around and into its joint limits where waypoints lie far apart; "
    "with slerp the motion is smooth.",
    "Each component of the quaternion is interpolated on its own, and q and −q are one orientation: where the "
    "product of the two is negative, the way between them is the longer one.",
    "If q₀ · q₁ < 0 take −q₁; then slerp.",
    "share of the way between two waypoints 60° apart",
    "off the shortest way [deg]",
    curves,
    tolerance=1e-6,
)
