"""Every law with the gains that make its greatest command from rest the same: what motors of one size allow.

At equal stiffness near the goal a law that asks for more far from it is the faster one, and pays for it in torque.
"""

from tasks.condition import Axis, Condition

AXIS = Axis(
    "equal-peak",
    "Greatest command from rest",
    "rad/s^2",
    (50.0, 100.0, 200.0, 400.0),
    None,
    lambda level: Condition(peak=level),
)
