"""Compare two states of the code: outcomes, operations, a user's faults, and time (`python -m bench compare`).

commits and checkouts make base and head ready; exact compares their rows; timed and timing time them in turn; gates
calls them all, comparison holds what was found, and summary writes it.
"""
