"""Jacobians of an arm's tool, one file each, with one constant JACOBIAN. The file name is the word."""
