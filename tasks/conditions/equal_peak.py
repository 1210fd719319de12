"""Every law with the gains that make its greatest command from rest the same: what motors of one size allow.

At equal stiffness near the goal a law that asks for more far from it is the faster one, and pays for it in torque.
"""

from tasks.axis import Axis, Field

AXIS = Axis(
    "equal-peak",
    "Greatest command from rest",
    "rad/s^2",
    (50.0, 100.0, 200.0, 400.0),
    None,
    (Field("peak", 0.0, "greatest command from rest that the gains give [rad/s^2]; 0: gains as set", lasts=False),),
)
