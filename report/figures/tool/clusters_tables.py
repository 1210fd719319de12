"""What episodes cost, as tables: by their number, and by who runs them."""

from __future__ import annotations

import pandas as pd

from bench.running.schedulers.words import THREADS
from report.figures.kit import html
from report.figures.kit.spelling import power
from report.figures.tool.clusters_rows import NOT_RUN

COST, PEAK, DISK = "CPU an episode [µs]", "Peak memory [MB]", "Rows on disk [B an episode]"
WALL, BY_CPU, BY_WALL, OTHERS = "Wall [s]", "Efficiency by CPU", "By wall time", "Others [cores]"


def sizes(rows: pd.DataFrame) -> html.Markdown:
    """A row a number of episodes: what one costs, and the memory of the whole run."""
    cells = [
        {
            "Episodes": power(one.episodes),
            "Runs": one.runs,
            COST: one.each_us,
            "Least to most": f"{one.least_us:.0f} to {one.most_us:.0f}" if one.runs > 1 else None,
            PEAK: one.peak_bytes / 1e6,
            DISK: one.row_bytes,
        }
        for one in rows.itertuples()
    ]
    return _table(cells, {COST: ".0f", PEAK: ".0f", DISK: ".0f"})


def schedulers(rows: pd.DataFrame) -> html.Markdown:
    """A row a scheduler: CPU, wall time, how much of its processes' time went into episodes, and what others took."""
    cells = [
        {
            "Scheduler": "one thread" if one.scheduler == THREADS else f"`{one.scheduler}`",
            COST: one.each_us,
            WALL: one.wall_s,
            BY_CPU: 100 * one.by_cpu,
            BY_WALL: 100 * one.by_wall,
            OTHERS: one.others,
        }
        for one in rows.itertuples()
    ]
    return _table(cells, {COST: ".0f", WALL: ".1f", BY_CPU: "{:.0f} %", BY_WALL: "{:.0f} %", OTHERS: ".2f"})


def _table(cells: list[dict], formats: dict[str, str]) -> html.Markdown:
    return html.table(pd.DataFrame(cells), formats) if cells else html.table(pd.DataFrame({"Rows": [NOT_RUN]}))
