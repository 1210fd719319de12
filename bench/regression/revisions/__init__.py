"""Compare two states of the code: outcomes, operations, a user's faults, and time (`bench compare`).

commits prepares base and head, exact compares rows, timed and timing measure, gates calls all of them.
"""
