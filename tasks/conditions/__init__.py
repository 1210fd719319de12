"""Perturbations of the free body: one file each, with a constant AXIS."""
