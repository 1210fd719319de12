"""The paper's three laws in the order of the paper, and their rows in a table of results."""

import pandas as pd

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
