"""A clip of each component turns the command."""

import numpy as np

from bench.contenders.registry import known_limiters
from bench.law.limiter import GREATEST_RATE
from bench.questions.question import Curves, Question

AROUND_DEG, LENGTH = np.linspace(0.0, 90.0, 91), 3.0 * GREATEST_RATE


def curves() -> Curves:
    """Angle between the command and what is left of it, behind each limiter."""
    made = []
    for name in ("axis-clamp", "norm-clamp"):
        limit, off = known_limiters()[name].limit, []
        for around in np.radians(AROUND_DEG):
            omega = LENGTH * np.array([np.cos(around), np.sin(around), 0.0])
            left = np.array(limit(tuple(omega.tolist()), 1.0))
            off.append(np.degrees(np.arctan2(np.linalg.norm(np.cross(omega, left)), omega @ left)))
        made.append(np.array(off))
    return Curves(AROUND_DEG, *made)


QUESTION = Question(
    "rcs-141",
    "A limit changes the direction",
    ("RobotControlStack/robot-control-stack#141",),
    "Limits on a relative motion were kept by clipping each component, which bends the vector away from what the agent "
    "asked for.",
    "A vector outside a cube is cut to the cube's face: what exceeds is shortened, what does not stays.",
    "Shorten the vector to the limit and keep its direction; of a rotation, the angle of the whole.",
    "direction of the command in a plane [deg]",
    "direction lost [deg]",
    curves,
    tolerance=1e-6,
)
