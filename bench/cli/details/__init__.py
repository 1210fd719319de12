"""What `show` prints in full, a file a part of the run: `tables(rows...)` yields titles, each with a data frame.

A cell a/b counts episodes: a of b settled; in contact, where an episode is a trial at a pose, a of b were done.
"""

PARTS = ("free-body", "arms", "contact", "robustness")
