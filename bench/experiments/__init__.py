"""What is run: the suites, the plan with its units, and the rows of each kind of unit."""
