"""Compare two states of the code: outcomes, operations, a user's faults, and time (`bench compare`)."""
