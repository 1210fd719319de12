"""Rows of a table of results, chosen and summed up as several pages do; the paper's three laws by name."""

import pandas as pd

from report.figures.kit.laws import TITLES

MATRIX, LINEARIZED, FEEDBACK = TITLES
SHORT = {"m": MATRIX, "l": LINEARIZED, "f": FEEDBACK}


def of(frame: pd.DataFrame, contender: str, start_set: str = "uniform") -> pd.DataFrame:
    """Rows of one law and start set."""
    return frame[(frame["contender"] == contender) & (frame["start_set"] == start_set)]


def gains(rows: pd.DataFrame) -> tuple[float, float]:
    """(kp, kv) of the rows."""
    return float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])
