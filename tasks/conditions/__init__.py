"""Axes of trouble: one file each, with a constant AXIS."""
