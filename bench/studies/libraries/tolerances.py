"""Define the differences that the study of libraries treats as none; the report states them without the study."""

from bench.audit.faults.digits_near_0 import COUNT_RAD as COUNT_RAD

SINGLE_RAD = 4.0 * 2.0**-22
"""The same as COUNT_RAD for a library of single precision: four units in the last place of pi, 9.5e-7 rad."""
ZERO_SHARE = 1e-6
"""An answer smaller than this times the angle counts as zero."""
WRONG_AXIS_RAD = 0.1
"""Angle between an answer and the axis beyond which the answer does not point along it: 6 degrees."""
