"""Free body and arms: what each law or controller settles from each start set, and counts of outcomes."""

from collections.abc import Callable, Iterator

import pandas as pd
import rich_click as click
from scipy.stats import binomtest

from bench.experiments.suites import IDEAL_MOTORS, NOMINAL
from bench.experiments.tables.run import with_contender
from tasks.cause import CAUSES
from tasks.verdict import CRASHED, OUTCOMES

FIRST = ("law", "settled of SO(3)", "median s", "worst s")
Rows = Iterator[tuple[str, pd.DataFrame]]
"""Titles or names, each with its rows."""

OF_STARTS = "a/b: a of b starts settled"
"""Above every table that has such cells."""


def settled(rows: pd.DataFrame) -> str:
    """How many episodes settled, of how many."""
    return f"{(rows['outcome'] == 'settled').sum()}/{len(rows)}"


def seconds(rows: pd.DataFrame) -> dict[str, str]:
    """Median and worst settling time."""
    times = rows["settling_time_s"].dropna()
    median, worst = (f"{times.median():.3f}", f"{times.max():.3f}") if len(times) else ("never", "never")
    return {"median s": median, "worst s": worst}


def tabulate(rows: pd.DataFrame, describe: Callable[[pd.DataFrame], dict], head: str = "controller") -> pd.DataFrame:
    """Return a line for each law or controller: its name, and what describe(its rows) returns by column."""
    named = with_contender(rows).groupby("contender", observed=True, sort=False)
    return pd.DataFrame([{head: str(name), **describe(own)} for name, own in named])


def places(episodes: pd.DataFrame) -> Rows:
    """Arm, or "free body", and engine; its rows."""
    for (engine, arm), part in episodes.groupby(["engine", "arm"], observed=True, sort=False):
        yield f"{arm or 'free body'}, {engine}", part


def by_start_set(rows: pd.DataFrame) -> dict[str, str]:
    """Return the settled of each start set."""
    groups = rows.groupby("start_set", observed=True, sort=True)
    return {str(start_set): settled(part) for start_set, part in groups}


def tables_of_free_body(episodes: pd.DataFrame) -> Rows:
    """Yield a table for each engine."""
    for place, part in places(episodes):
        yield f"{place} ({OF_STARTS}; share of SO(3) and times from uniform starts)", summarize_laws(part)


def tables_of_arms(episodes: pd.DataFrame) -> Rows:
    """Yield a table for each arm, then one for each whose plant is not the controller's model."""
    plant = episodes["variation"].astype(str)
    is_usual = plant.isin((NOMINAL, IDEAL_MOTORS))
    usual = episodes[is_usual].assign(plant=plant)
    for (variation, kp), rows in usual.groupby(["plant", "kp"], sort=False):
        for place, part in places(rows):
            yield f"{place}, {variation}, kp {kp:g} ({OF_STARTS})", tabulate(part, describe_controller)
    for place, part in places(episodes[~is_usual]):
        title = f"{place}, other motors or model errors ({OF_STARTS}; then the median final angle [mrad])"
        yield title, tabulate(part, describe_variations)


def summarize_laws(episodes: pd.DataFrame) -> pd.DataFrame:
    """One line for each law: share of SO(3) settled with its Wilson 95 % interval, settling times [s], other starts."""

    def describe(own: pd.DataFrame) -> dict[str, str]:
        line, uniform = by_start_set(own), own[own["start_set"] == "uniform"]
        if line.pop("uniform", ""):
            number = int((uniform["outcome"] == "settled").sum())
            low, high = binomtest(number, len(uniform)).proportion_ci(method="wilson")
            line["settled of SO(3)"] = f"{number / len(uniform):.2%} [{low:.2%}, {high:.2%}]"
            line |= seconds(uniform)
        return line

    table = tabulate(episodes, describe, "law")
    first = [name for name in FIRST if name in table]
    return table[first + [name for name in table if name not in first]]


def describe_controller(rows: pd.DataFrame) -> dict[str, str]:
    """Return settled of each start set, settling times [s], and the causes of failures."""
    causes = rows["cause"].astype(str).value_counts()
    near = ", ".join(f"{causes[one]} {one}" for one in CAUSES if one and one in causes)
    return {**by_start_set(rows), **seconds(rows), "failures near": near}


def describe_variations(rows: pd.DataFrame) -> dict[str, str]:
    """Return for each variation of the plant: settled, and the median angle left."""
    groups = rows.groupby("variation", observed=True, sort=False)
    return {str(one): f"{settled(own)}  {1e3 * own['final_angle_rad'].median():.3g}" for one, own in groups}


def of_laws(rows: pd.DataFrame, folder: str, words: tuple[str, ...]) -> pd.DataFrame:
    """Return the rows of the laws: by regulator, with its representation, or with its Jacobian and inverse too."""
    if not words:
        return rows
    named = with_contender(rows)
    law = named["contender"].astype(str)
    names = pd.DataFrame({"regulator": named["regulator"].astype(str), "law": law.str.partition("@")[0], "whole": law})
    for word in words:
        if not (names == word).to_numpy().any():
            known = ", ".join(sorted(names["law"].unique()))
            raise click.UsageError(f"{folder} has no regulator '{word}'; it has: {known or 'none'}")
    return rows[names.isin(words).any(axis=1).to_numpy()]


def outcome_table(episodes: pd.DataFrame) -> pd.DataFrame:
    """One line for each start set and law: counts of outcomes, then median and worst settling time [s]."""
    varies = "variation" in episodes and (episodes["variation"] != NOMINAL).any()
    keys = ["start_set", "variation", "law"] if varies else ["start_set", "law"]
    named = with_contender(episodes).rename(columns={"contender": "law"})
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
