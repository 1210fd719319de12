"""Values of the laws' calls at single states."""

EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad from a pole or from 180°) and what rounding leaves of an exact
one (4e-16 rad)."""

GROWTH_DECADES = (3, 8)
