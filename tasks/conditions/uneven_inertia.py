"""A body that is no ball, though the law's model is: principal moments 1 - s, 1 and 1 + s times the model's.

The gyroscopic torque comes with them. No rigid body has s above 1/2: the two smaller moments sum to no less than the
largest.
"""

from tasks.axis import Axis

AXIS = Axis(
    "uneven-inertia",
    "Unevenness of the inertia",
    "1",
    (0.0, 0.1, 0.2, 0.3, 0.4, 0.5),
    0.0,
    sets=lambda level: {"inertia": (1.0 - level, 1.0, 1.0 + level)},
)
