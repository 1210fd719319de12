"""Rows of one law in a table of episodes, and the paper's three laws by name."""

import pandas as pd

MATRIX, LINEARIZED, FEEDBACK = "rotation-matrix", "linearized-euler/zyx-euler", "feedback-linearized/zyx-euler"
SHORT = {"m": MATRIX, "l": LINEARIZED, "f": FEEDBACK}


def of(frame: pd.DataFrame, contender: str, start_set: str = "uniform") -> pd.DataFrame:
    """Rows of one law and start set."""
    return frame[(frame["contender"] == contender) & (frame["start_set"] == start_set)]


def lost(rows: pd.DataFrame) -> pd.DataFrame:
    """Those that did not settle."""
    return rows[rows["outcome"] != "settled"]
