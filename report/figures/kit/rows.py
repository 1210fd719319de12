"""Rows of a table of results, chosen and summed up as several pages do; the paper's three laws by name."""

import pandas as pd

from bench.findings.theory.closed_form import linear_settling
from report.figures.kit.laws import TITLES

MATRIX, LINEARIZED, FEEDBACK = TITLES
SHORT = {"m": MATRIX, "l": LINEARIZED, "f": FEEDBACK}


def of(frame: pd.DataFrame, contender: str, start_set: str = "uniform") -> pd.DataFrame:
    """Rows of one law and start set."""
    return frame[(frame["contender"] == contender) & (frame["start_set"] == start_set)]


def lost(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows that did not settle."""
    return rows[rows["outcome"] != "settled"]


def small_error_settling_s(episodes: pd.DataFrame) -> float:
    """Settling time of a small error, from the closed form and the run's gains and band [s]."""
    kp, kv, band = (float(episodes[column].iloc[0]) for column in ("kp", "kv", "tolerance"))
    return linear_settling(kp, kv, band)
