"""What the pages on trouble say of any axis: who loses starts, who gets slower; and words for a run without it."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable

import numpy as np
import pandas as pd

import tasks
from bench.tables.statistics import quantile
from report.figures.kit import absent, families
from report.figures.kit.share import share
from report.figures.robustness import robustness_rows

DEG = 180.0 / math.pi


def needs(keys: str) -> Callable:
    """Decorate facts of rows: without rows every key has the words that say so."""

    def decorate(facts: Callable[..., dict]) -> Callable[..., dict]:
        @functools.wraps(facts)
        def told(rows: pd.DataFrame, *more) -> dict:
            return facts(rows, *more) if len(rows) else dict.fromkeys(keys.split(), absent.WORDS)

        return told

    return decorate


def own_laws(rows: pd.DataFrame) -> list[str]:
    """The laws that are no negative controls."""
    return [law for law in robustness_rows.laws(rows) if law not in families.CONTROLS]


def medians(rows: pd.DataFrame, column: str = "time_s") -> pd.DataFrame:
    """Median of a column: a row a level, a column a law; controls left out."""
    kept = rows[rows["contender"].isin(own_laws(rows))]
    middle = kept.groupby(["level", "contender"], observed=True)[column].apply(
        lambda part: float(quantile(part.to_numpy(), 0.5))
    )
    return middle.unstack()


def losses(rows: pd.DataFrame, name: str) -> str:
    """From which laws fewer starts go well at the worst level than without trouble, in words, with Wilson intervals."""
    before, after = (
        rows[rows["level"] == level].groupby("contender", observed=True)["good"]
        for level in (robustness_rows.nominal(tasks.axis(name)), robustness_rows.worst(rows, name))
    )
    parts = []
    for law in own_laws(rows):
        if after.sum()[law] < before.sum()[law]:
            kept = share(int(after.sum()[law]), int(after.size()[law]))
            low, high = 100.0 * kept.low, 100.0 * kept.high
            parts.append(f"{families.word(law)} ({kept.k} of {kept.n}; {low:.0f} to {high:.0f} %)")
    if not parts:
        return "No law loses a start there that goes well without trouble."
    return f"There fewer starts go well than without trouble for {listed(parts)}."


def listed(words: Iterable[str]) -> str:
    """The words with commas and an "and"."""
    *most, last = words
    return f"{', '.join(most)} and {last}" if most else last


def ends(rows: pd.DataFrame, name: str) -> dict:
    """What every page says: starts, laws, levels."""
    return {
        "n": int(rows.groupby(["contender", "level"], observed=True).size().max()),
        "laws": len(robustness_rows.laws(rows)),
        "worst": robustness_rows.said(robustness_rows.worst(rows, name), name),
        "losses": losses(rows, name),
    }


def slower(rows: pd.DataFrame, name: str) -> pd.Series:
    """Median settling time at the worst level over that without trouble, law by law, of laws that have both."""
    table = medians(rows)
    ratio = table.loc[robustness_rows.worst(rows, name)] / table.loc[robustness_rows.nominal(tasks.axis(name))]
    return ratio[np.isfinite(ratio)]


def signed(ratio: float) -> str:
    """A ratio as what it adds in per cent, with its sign."""
    return f"{round(100.0 * (ratio - 1.0)):+d}".replace("-", "−")
