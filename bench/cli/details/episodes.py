"""What the free body and arms have in common: rows that were asked for, places, counts of outcomes."""

import pandas as pd
import rich_click as click

from bench.experiments.suites import NOMINAL
from bench.experiments.tables import read as results
from tasks.verdict import CRASHED, OUTCOMES

OF_STARTS = "a/b: a of b starts settled"
"""Above every table that has such cells."""


def settled(rows) -> str:
    """How many episodes settled, of how many."""
    return f"{(rows['outcome'] == 'settled').sum()}/{len(rows)}"


def seconds(rows) -> dict[str, str]:
    """Median and worst settling time."""
    times = rows["settling_time_s"].dropna()
    median, worst = (f"{times.median():.3f}", f"{times.max():.3f}") if len(times) else ("never", "never")
    return {"median s": median, "worst s": worst}


def by_contender(rows):
    """Name of a law or controller, its rows."""
    for name, own in results.with_contender(rows).groupby("contender", observed=True, sort=False):
        yield str(name), own


def places(episodes):
    """Arm, or "free body", and engine; its rows."""
    for (engine, arm), part in episodes.groupby(["engine", "arm"], observed=True, sort=False):
        yield f"{arm or 'free body'}, {engine}", part


def only(episodes, folder, column: str, words):
    """The rows that have one of some words in a column; all if there are no words.

    Errors:
        UsageError: a word that no row has.
    """
    known = sorted(episodes[column].unique())
    for word in words:
        if word not in known:
            kind = column.replace("_", " ")
            raise click.UsageError(f"{folder} has no {kind} '{word}'; it has: {', '.join(known) or 'none'}")
    return episodes[episodes[column].isin(words)] if words else episodes


def of_laws(rows, folder, words):
    """The rows of the laws: by regulator, with its representation, or with its Jacobian and inverse too.

    Errors:
        UsageError: a word that names no law of the rows.
    """
    if not words:
        return rows
    named = results.with_contender(rows)
    law = named["contender"].astype(str)
    names = pd.DataFrame({"regulator": named["regulator"].astype(str), "law": law.str.partition("@")[0], "whole": law})
    for word in words:
        if not (names == word).to_numpy().any():
            known = ", ".join(sorted(names["law"].unique()))
            raise click.UsageError(f"{folder} has no regulator '{word}'; it has: {known or 'none'}")
    return rows[names.isin(words).any(axis=1).to_numpy()]


def outcome_table(episodes):
    """One line for each start set and law: counts of outcomes, then median and worst settling time [s]."""
    varies = "variation" in episodes and (episodes["variation"] != NOMINAL).any()
    keys = ["start_set", "variation", "law"] if varies else ["start_set", "law"]
    named = results.with_contender(episodes).rename(columns={"contender": "law"})
    grouped = named.groupby(keys, observed=True, sort=False)
    usual = [word for code, word in enumerate(OUTCOMES) if code < CRASHED or (episodes["outcome"] == word).any()]
    counts = grouped["outcome"].value_counts().unstack(fill_value=0).reindex(columns=usual, fill_value=0)
    counts.insert(0, "n", grouped.size())
    counts["median s"] = grouped["settling_time_s"].median().round(3)
    counts["worst s"] = grouped["settling_time_s"].max().round(3)
    table = counts.reset_index()
    for key in keys:
        table[key] = table[key].astype(str)
    return table.sort_values(keys)
