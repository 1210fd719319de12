"""What `show` prints in full, a file a part of the run.

A part has `tables(rows...)`: titles, each with a data frame. In every table a cell a/b counts episodes: a of b settled;
in contact, where an episode is a trial at a pose, a of b were done.
"""

from bench.experiments.experiment import known_experiments


def parts() -> tuple[str, ...]:
    """Their words on the command line; last the experiments that bring a table of their own."""
    own = (name for name, one in known_experiments().items() if one.summary)
    return ("free-body", "arms", "contact", "robustness", *own)
