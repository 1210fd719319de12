"""Values of what is measured of three variables of an orientation."""

WAYS, LEGS = 200, 5
"""Pairs of paths with the same ends; turns about one axis, one after the other."""

MATRICES, PAIRS = 200, 12
"""Random orientations, and pairs of outer angles."""

STEPS = 200
"""Points of a straight way: its length is then short by less than a thousandth."""
