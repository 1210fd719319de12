"""Rows of a table of results, chosen and summed up as several pages do; the paper's three laws by name."""

import pandas as pd

from bench.findings.theory.closed_form import linear_settling
from report.figures.kit import html
from report.figures.kit.laws import TITLES

MATRIX, LINEARIZED, FEEDBACK = TITLES
SHORT = {"m": MATRIX, "l": LINEARIZED, "f": FEEDBACK}


def of(frame: pd.DataFrame, contender: str, start_set: str = "uniform") -> pd.DataFrame:
    """Rows of one law and start set."""
    return frame[(frame["contender"] == contender) & (frame["start_set"] == start_set)]


def lost(rows: pd.DataFrame) -> pd.DataFrame:
    """Those that did not settle."""
    return rows[rows["outcome"] != "settled"]


def uniform_starts(episodes: pd.DataFrame) -> str:
    """How many uniform starts a law met on the continuous plant; from fewest to most where laws differ."""
    mine = episodes[(episodes["start_set"] == "uniform") & (episodes["engine"] == "ideal-rk4")]
    counts = mine["contender"].astype(str).value_counts()
    fewest, most = (html.number(counts.iloc[place]) for place in (-1, 0))
    return most if fewest == most else f"{fewest} to {most}"


def small_error_settling_s(episodes: pd.DataFrame) -> float:
    """Settling time of a small error, from the closed form and the run's gains and band [s]."""
    kp, kv, band = (float(episodes[column].iloc[0]) for column in ("kp", "kv", "tolerance"))
    return linear_settling(kp, kv, band)
