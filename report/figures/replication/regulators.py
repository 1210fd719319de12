"""The paper's three regulators in a table: the paper's words, what settles, how fast, and where each fails."""

import math
from collections.abc import Iterator
from typing import Any

import pandas as pd

from bench.experiments.tables.run import Run, require_rows
from bench.experiments.tables.statistics import Estimate
from bench.findings.conclusions import conclude, name_starts
from bench.findings.failure_places import describe_failures
from bench.findings.replication import measure_settling, starts_at_rest
from report.figures.kit import families, html
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.quotes import quote
from report.figures.kit.spelling import prose

REGULATORS = html.PageTable(
    "Regulator | Murphy's words | Starts that settle [%] | Median settling time [s] | "
    "Time in which 99 % of the starts settle [s] | Starts from which the regulator fails"
)

CONCLUSIONS = {MATRIX: "rotation-matrix", LINEARIZED: "linearized-euler", FEEDBACK: "feedback-linearized"}
"""Law -> the conclusion about it."""

QUOTED = {"half_turn": "C04", "slow": "C03", "range": "C06", "pole": "C07", "divide": "C10"}
"""Key of a sentence on the page -> its claim."""


def facts(run: Run) -> dict[str, Any]:
    """Return the table, its number of uniform starts, and the paper's sentences."""
    rows = starts_at_rest(run)
    uniform = rows[rows["start_set"] == "uniform"]
    counts = [int((uniform["contender"] == law).sum()) for law in CONCLUSIONS]
    quotes = {f"quote_{key}": quote(claim) for key, claim in QUOTED.items()}
    return {**quotes, "starts": min(counts), "table": REGULATORS(list_laws(run, rows))}


def list_laws(run: Run, rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row for each of the paper's regulators."""
    words = {conclusion.name: conclusion.quote for conclusion in conclude(run)}
    for law, name in CONCLUSIONS.items():
        episodes = require_rows(rows[rows["contender"] == law], f"episode of {law}")
        settling = measure_settling(episodes)
        share = settling.share
        places = [prose(name_starts(place)) for place in describe_failures(episodes)]
        yield (
            families.link(law, families.word(law)),
            f"“{prose(words[name])}”",
            f"{100 * share.value:.1f} ({100 * share.low:.1f} to {100 * share.high:.1f})",
            describe_time(settling.median),
            describe_time(settling.nearly_all),
            "; ".join(places) or "no start",
        )


def describe_time(time: Estimate) -> str:
    """Write a settling time with its interval; a law that so many starts never settle with has none."""
    if math.isinf(time.value):
        return "never"
    high = html.number(time.high) if math.isinf(time.high) else f"{time.high:.2f}"
    return f"{time.value:.2f} ({time.low:.2f} to {high})"
