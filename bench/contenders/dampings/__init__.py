"""Designs of damping for an impedance without inertia shaping, one file each with a constant DAMPING."""
