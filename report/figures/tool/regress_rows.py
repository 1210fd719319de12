"""The study of the regression gate as its page reads it: results/regress, which is committed."""

from __future__ import annotations

from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from bench.regression.revisions.comparison import SAME
from bench.studies.gates import FOLDER
from bench.tables.store import read_json
from report.figures.kit import style

NOT_RUN = "This part of the study has not been run yet: make regress-study"


def part(name: str) -> list[dict[str, Any]]:
    """The rows of same_code, power or faults; none if it has not been run."""
    path = FOLDER / f"{name}.json"
    return read_json(path)["rows"] if path.is_file() else []


def not_run(narrow: bool) -> tuple[Figure, str]:
    """The words alone, in the place of a figure."""
    figure, axes = style.panels(height=0.6, narrow=narrow)
    axes.axis("off")
    axes.text(0.5, 0.5, NOT_RUN.replace(": ", ":\n"), ha="center", va="center", color=style.MUTED)
    return figure, f"{NOT_RUN}."


def verdicts() -> pd.DataFrame:
    """A row for each benchmark of each comparison of the same code.

    Columns: comparison, neighbours (busy processes), benchmark, ratio and p of the first run, `doubted` (its verdict
    was not "same") and `alarm` (a second run agreed).
    """
    rows = [
        {
            "comparison": number,
            "neighbours": sum(one["load"].values()),
            "benchmark": name,
            "ratio": said["ratio"],
            "p": said["p"],
            "doubted": name in one["doubted"],
            "alarm": name in one["doubted"] and one["doubted"][name]["verdict"] != SAME,
        }
        for number, one in enumerate(part("same_code"), start=1)
        for name, said in one["timed"].items()
    ]
    return pd.DataFrame(rows)


def counts_apart() -> pd.Series:
    """Instructions of the same code, head over base - 1; one for each law of each comparison that counted them."""
    return pd.Series(
        [apart for one in part("same_code") for apart in (one["instructions"] or {}).values()], dtype=float
    )


def power() -> pd.DataFrame:
    """A row for each planted step: how much slower, the shares found by one run and by two, and more instructions."""
    found = [
        {
            "steps": one["steps"],
            "slower": one["slower"],
            "repeats": one["repeats"],
            "once": one["once"] / one["repeats"],
            "twice": one["twice"] / one["repeats"],
            "instructions": one["instructions"][1] / one["instructions"][0] - 1.0,
        }
        for one in part("power")
        if one["instructions"]
    ]
    return pd.DataFrame(found).sort_values("slower", ignore_index=True) if found else pd.DataFrame()
