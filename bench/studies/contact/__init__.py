"""What tasks in contact hang on: stiffness, delay and noise; the fit of a peg; the stiffness of springs."""
