"""A goal that sways about two axes at once, with its angular velocity and acceleration in closed form.

    R_d(t) = exp(p [z]x) exp(q [x]x) R_d(0),   p = c sin(2 t)/2,   q = c sin(3.1 t)/3.1,   c = amplitude/sqrt(2)
    omega_d = pdot z + qdot exp(p [z]x) x
    alpha_d = pddot z + qddot exp(p [z]x) x + pdot qdot exp(p [z]x) y

The two axes z and exp(p [z]x) x stay at right angles: |omega_d|^2 = pdot^2 + qdot^2 <= amplitude^2, reached at t = 0.
"""

import math

NO_FEEDFORWARD, RATE, RATE_AND_ACCELERATION = range(3)
"""What a law is given of a moving goal beside where it is."""


def reference_column(time, amplitude, column):
    """Return a column of R_d at a time [s], from the column at time 0, base frame; amplitude: peak rate [rad/s]."""
    peak = amplitude * math.sqrt(0.5)
    p, q = peak * math.sin(2.0 * time) / 2.0, peak * math.sin(3.1 * time) / 3.1
    cos_p, sin_p, cos_q, sin_q = math.cos(p), math.sin(p), math.cos(q), math.sin(q)
    y = cos_q * column[1] - sin_q * column[2]
    z = sin_q * column[1] + cos_q * column[2]
    return (cos_p * column[0] - sin_p * y, sin_p * column[0] + cos_p * y, z)


def reference_rates(time, amplitude):
    """(omega_d, alpha_d) at a time [rad/s, rad/s^2], base frame."""
    peak = amplitude * math.sqrt(0.5)
    p = peak * math.sin(2.0 * time) / 2.0
    pdot, qdot = peak * math.cos(2.0 * time), peak * math.cos(3.1 * time)
    pddot, qddot = -2.0 * peak * math.sin(2.0 * time), -3.1 * peak * math.sin(3.1 * time)
    cos_p, sin_p = math.cos(p), math.sin(p)
    omega = (qdot * cos_p, qdot * sin_p, pdot)
    alpha = (qddot * cos_p - pdot * qdot * sin_p, qddot * sin_p + pdot * qdot * cos_p, pddot)
    return omega, alpha
