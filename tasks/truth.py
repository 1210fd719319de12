"""The judge's measure of the orientation error, in plain `math` on scalars.

The error is the angle theta of the rotation conj(goal) * quat. It is computed from MuJoCo's quaternion and not from a
matrix: the vector part, |v| = sin(theta/2), keeps its digits at theta = 0, and the scalar part, |s| = cos(theta/2),
keeps them at theta = pi. An arc cosine of the trace loses half of its digits at both ends.

The two functions call no other function of ours, so that compiled loops compile them as they stand.
"""

from __future__ import annotations

import math


def haversine(quat, goal):
    """Return sin^2(theta/2), theta the angle between two orientations wxyz of any norm but zero.

    |v|^2 / (|v|^2 + s^2) with s, v the parts of conj(goal) * quat: free of square roots, monotonic in theta
    on [0, pi], and indifferent to a common scale or the sign of either quaternion.
    """
    s = goal[0] * quat[0] + goal[1] * quat[1] + goal[2] * quat[2] + goal[3] * quat[3]
    x = goal[0] * quat[1] - goal[1] * quat[0] - goal[2] * quat[3] + goal[3] * quat[2]
    y = goal[0] * quat[2] - goal[2] * quat[0] - goal[3] * quat[1] + goal[1] * quat[3]
    z = goal[0] * quat[3] - goal[3] * quat[0] - goal[1] * quat[2] + goal[2] * quat[1]
    square = x * x + y * y + z * z
    return square / (square + s * s)


def angle(quat, goal):
    """Return the angle between two orientations wxyz of any norm but zero, right to a few 1e-16 rad on all of [0, pi].

    theta = 2 atan2(|v|, |s|) with s, v the parts of conj(goal) * quat.
    """
    s = goal[0] * quat[0] + goal[1] * quat[1] + goal[2] * quat[2] + goal[3] * quat[3]
    x = goal[0] * quat[1] - goal[1] * quat[0] - goal[2] * quat[3] + goal[3] * quat[2]
    y = goal[0] * quat[2] - goal[2] * quat[0] - goal[3] * quat[1] + goal[1] * quat[3]
    z = goal[0] * quat[3] - goal[3] * quat[0] - goal[1] * quat[2] + goal[2] * quat[1]
    return 2.0 * math.atan2(math.sqrt(x * x + y * y + z * z), math.fabs(s))
