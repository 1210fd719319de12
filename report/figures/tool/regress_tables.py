"""The planted faults as a table: what was planted, which gates caught it, and in what words."""

from __future__ import annotations

from typing import Any

import pandas as pd

from report.figures.kit import html
from report.figures.tool.regress_rows import NOT_RUN


def faults(rows: list[dict[str, Any]]) -> html.Markdown:
    """A row a fault; the one in which nothing was planted must be caught by nothing."""
    cells = [
        {
            "Planted": one["fault"],
            "In": one["law"] or html.MISSING,
            "Caught by": ", ".join(one["gates"]) or "nothing",
            "In the words": html.foreign(one["says"][0]) if one["says"] else html.MISSING,
        }
        for one in rows
    ]
    return html.table(pd.DataFrame(cells or [{"Planted": NOT_RUN}]))
