"""What tasks in contact depend on: stiffness, delay; admittance, shaped inertia; fit of a peg; springs."""
