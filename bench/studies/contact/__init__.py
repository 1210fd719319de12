"""What tasks in contact depend on: stiffness, delay and noise; the fit of a peg; the stiffness of springs."""
