"""What stands on a page in place of a figure or a number that a smaller run does not hold."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from bench.tables import read
from report.figures.kit import html, style
from report.figures.kit.inline import Picture, responsive_picture

WORDS = "not in this run"


def robustness(**words: str) -> pd.DataFrame:
    """Rows of robustness.parquet; none where the run is from before there was such a table."""
    is_there = (read.folder() / "robustness.parquet").is_file()
    return read.robustness(**words) if is_there else pd.DataFrame()


@responsive_picture
def absent(what: str, narrow: bool):
    """The words alone, in the place of a figure."""
    figure, axes = style.panels(height=0.6, narrow=narrow)
    axes.axis("off")
    axes.text(0.5, 0.5, f"{what}: {WORDS}", ha="center", va="center", color=style.MUTED, transform=axes.transAxes)
    return figure, f"{what}: {WORDS}. The default suite holds it."


def picture(rows: pd.DataFrame, draw: Callable[[pd.DataFrame], Picture], what: str) -> Picture:
    """draw(rows), or the words if there are no rows."""
    return draw(rows) if len(rows) else absent(what)


def table(rows: pd.DataFrame, write: Callable[[pd.DataFrame], html.Markdown]) -> html.Markdown:
    """write(rows), or the words if there are no rows."""
    return write(rows) if len(rows) else html.table(pd.DataFrame({"Rows": [WORDS]}))
