"""What tasks in contact depend on: stiffness, delay, noise; admittance, shaped inertia; fit of a peg; springs."""
