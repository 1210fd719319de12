"""What `show` prints in full, a file a part of the run.

A part has `tables(rows...)`: titles, each with a data frame. In every table a cell a/b counts episodes: a of b settled;
in contact, where an episode is a trial at a pose, a of b were done.
"""

PARTS = ("free-body", "arms", "contact", "robustness")
