"""The paper's three laws in the order of the paper, and their rows in a table of results; all laws but the later."""

import pandas as pd

from bench.contenders.registry import known_regulators

TITLES = {
    "rotation-matrix": "Rotation matrix",
    "linearized-euler/zyx-euler": "Linearized Euler",
    "feedback-linearized/zyx-euler": "Feedback-linearized Euler",
}
"""contender -> how it is called in a figure."""


def each(frame: pd.DataFrame) -> list[tuple[str, str, pd.DataFrame]]:
    """(contender, title, its rows) of each of the three that the table holds."""
    parts = ((name, title, frame[frame["contender"] == name]) for name, title in TITLES.items())
    return [(name, title, rows) for name, title, rows in parts if len(rows)]


def without_later(frame: pd.DataFrame) -> pd.DataFrame:
    """The rows of the paper's laws in any coordinates, and of the user's own: what the paper's chapters are about."""
    later = {name for name, one in known_regulators().items() if one.later}
    return frame[~frame["regulator"].isin(later)].reset_index(drop=True)
