"""Values of what is measured of coordinates at single orientations."""

import math

HALF = math.sqrt(0.5)
ABOUT_Y = {
    180: (0.0, 0.0, 1.0, 0.0),
    90: (HALF, 0.0, HALF, 0.0),
    -90: (HALF, 0.0, -HALF, 0.0),
}
"""Quaternions of rotations about Y by so many degrees: the last two are the poles of Z-Y-X angles."""

ANGLE_AND_AXIS = "angle and axis"
"""The angle, and the polar and azimuth angle of the axis: coordinates that no controller here uses."""

DECADES = (1, 6)
"""Rotations from 10^-1 down to 10^-6 rad."""

TURNS, TURNS_ELSEWHERE = 2000, 200
"""Haar-random orientations at which work is balanced, and of every other representation."""

POLE_DECADES, BESIDE = 12, 20
"""Distances from each pole down to 1e-12 rad, and orientations at each."""

AT_POLE = "exact"
"""How the names of cases exactly at a pole begin."""

FORM_DECADES, PAIRS = 6, 12
"""Distances from the pole of each form down to 1e-6 rad, and pairs of the other two angles."""
