"""A row a law, with the columns that the rule of `regions` reads, made of the rows of a run.

The map's rows are made of situations; these are made of what a run has: the free body, arms, and robots that are
commanded in velocity. So one rule decides everywhere, on the rows of each robot.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.base.errors import BadResults, NoEvidence
from bench.experiments.situations import AWAY_RAD, CROWD
from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import quantile
from bench.findings.claims.adequacy import DETOUR, HELD_RAD, NOISE
from bench.findings.on_arms import passed
from bench.findings.selection.pairs import compare_shares, compare_times
from bench.findings.selection.regions import FACTS, find_facts
from bench.findings.selection.tables import (
    ComparedRows,
    by_law,
    by_standard_inverse,
    common,
    select_rows,
)

OF_RUN = "run"
"""The situation of all rows: that of the run."""

EXACT = "half-turn"
"""The start set of exact 180° rotations."""


class Compared(NamedTuple):
    """Laws compared on the starts of a run.

    Attributes:
        tables: The rows of the run.
        rows: A row a law, as in situations.parquet; times in seconds. NaN where a law was not run for a number.
        pairs: Every two laws, by the paired bootstrap over the starts that both ran.
    """

    tables: ComparedRows
    rows: pd.DataFrame
    pairs: pd.DataFrame

    @property
    def laws(self) -> list[str]:
        """Return the laws, the simplest first."""
        return self.rows["contender"].tolist()

    def row(self, law: str) -> dict:
        """Return the row of a law."""
        [row] = self.rows[self.rows["contender"] == law].to_dict("records")
        return {str(name): value for name, value in row.items()}


def compare_free_body(run: Run) -> Compared:
    """Return every law of a run from the uniform starts of the free body that all laws ran.

    Beside what the rule reads: `directed`, the directed starts that do not settle; `detour`, the longest path over the
    shortest, from uniform starts and 180° rotations; `held`, the least noise tried that traps the law at 180°.
    """
    tables = select_rows(run)
    uniform, directed = tables.uniform, tables.directed
    exact = directed[directed["start_set"] == EXACT]
    times = by_law(uniform, "settling_time_s", math.inf)
    ways = pd.concat([uniform, exact]).groupby("contender")["path_ratio"].max()
    noise = tables.robustness[tables.robustness["axis"] == NOISE]
    worst = noise[noise["level"] <= HELD_RAD]
    numbers = {
        **count_from_rest(tables),
        "stuck": count(exact, exact["lost"]),
        "trapped": count(worst, worst["lost"]),
        "directed": count(directed, directed["lost"]),
        "detour": ways,
        "held": noise["level"].where(noise["lost"], math.inf).groupby(noise["contender"]).min(),
        "time": take(times, CROWD),
    }
    return Compared(tables, make_rows(tables, numbers), tabulate_pairs(compare_times(times)))


def compare_arms(run: Run) -> Compared:
    """Return every law of a run on its arms, whose goals are never exactly 180° away, by the turns that miss.

    `missed` is the share of the turns that do not settle, or that need a motor's rating or the end of a joint's range.
    Motors and joints stop some turns of every law: the time of 99 % of the turns is infinite for all. So lost starts,
    detours and overshoot are those of the free body, which nothing stops, and the share of the turns decides.
    """
    tables = select_rows(run)
    arms = keep_whole(tables.arms[tables.arms["contender"].isin(tables.contenders)])
    if arms.empty:
        raise NoEvidence("no law was run on an arm (try: bench run --task arm-regulation)")
    misses = by_law(arms.assign(is_missed=~passed(arms)["range"]), "is_missed")
    numbers = {
        **count_from_rest(tables),
        "stuck": dict.fromkeys(misses, 0.0),
        "missed": {law: own.mean() for law, own in misses.items()},
    }
    return Compared(tables, make_rows(tables, numbers), tabulate_pairs(compare_shares(misses)))


def compare_velocities(run: Run) -> Compared:
    """Return every first-order law at the full share of K, without a limiter, from uniform starts of the free body."""
    tables, rows = read_velocities(run)
    uniform, _ = split_free_body(rows)
    return _compare_first_order(tables, rows, uniform)


def compare_positions(run: Run) -> Compared:
    """Return every first-order law on arms whose servos lag.

    A position loop of time constant T that is given the integral of omega moves as a servo of velocity with lag T does:
    (q_d - q)/T is omega through 1/(T s + 1).
    """
    tables, rows = read_velocities(run)
    late = keep_whole(by_standard_inverse(rows[rows["lag_s"] > 0.0]))
    if late.empty:
        raise NoEvidence("no robot was run with servos that lag (try: bench run --experiment velocity)")
    return _compare_first_order(tables, rows, late)


def _compare_first_order(tables: ComparedRows, rows: pd.DataFrame, starts: pd.DataFrame) -> Compared:
    """Return first-order laws by the times of these starts; detours and 180° rotations are those of the free body."""
    uniform, exact = split_free_body(rows)
    is_away = uniform["furthest_rad"] > uniform["angle0_rad"] + AWAY_RAD
    times = by_law(starts, "settling_time_s", math.inf)
    numbers = {
        "lost": count(starts, starts["lost"]),
        "stuck": count(exact, exact["lost"]),
        "unwound": count(uniform, is_away),
        "time": take(times, CROWD),
    }
    return Compared(tables, make_rows(tables, numbers), tabulate_pairs(compare_times(times)))


def read_velocities(run: Run) -> tuple[ComparedRows, pd.DataFrame]:
    """Return the tables of a run, and its rows of the first-order laws that these compare."""
    advice = "no robot was commanded by velocities (try: bench run --experiment velocity)"
    try:
        rows = run.table("velocity", limiter="none")
    except BadResults as error:  # a run that is older than the table
        raise NoEvidence(advice) from error
    rows = rows[rows["share"] == 1.0] if len(rows) else rows
    if rows.empty:
        raise NoEvidence(advice)
    law = rows["contender"].astype(str).str.partition("@")[0]
    rows = rows.assign(contender=law, lost=rows["outcome"].astype(str) != "settled")
    tables = select_rows(run)
    return tables, rows[rows["contender"].isin(tables.contenders)]


def split_free_body(rows: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return the uniform starts and the exact 180° rotations of the free body that every first-order law ran."""
    free = rows[rows["arm"] == ""]
    uniform, exact = (common(free[free["start_set"] == name]) for name in ("uniform", EXACT))
    return uniform, exact


def keep_whole(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of the laws that ran as many starts as any law did: the others cannot be compared with them."""
    starts = rows.groupby("contender")["start_id"].transform("size")
    return rows[starts == starts.max()]


def count_from_rest(tables: ComparedRows) -> dict[str, pd.Series]:
    """Return what the uniform starts of the free body count: lost, unwound, and the overshoot of 99 % [deg]."""
    uniform = tables.uniform
    overshoot = {law: np.degrees(own) for law, own in by_law(uniform, "overshoot_rad").items()}
    return {
        "lost": count(uniform, uniform["lost"]),
        "unwound": count(uniform, uniform["path_ratio"] > DETOUR),
        "overshoot": take(overshoot, CROWD),
    }


def count(rows: pd.DataFrame, is_counted: pd.Series) -> pd.Series:
    """Return how many rows of each law are counted."""
    return is_counted.groupby(rows["contender"].astype(str)).sum().astype(float)


def take(values: Mapping[str, np.ndarray], level: float) -> pd.Series:
    """Return a quantile of the values of each law."""
    return pd.Series({law: float(quantile(own, level)) for law, own in values.items()}, dtype=float)


def make_rows(tables: ComparedRows, numbers: Mapping[str, Mapping[str, float] | pd.Series]) -> pd.DataFrame:
    """Return the rows of the laws that have all numbers which decide; numbers: column -> law -> number."""
    columns = pd.DataFrame({name: pd.Series(own, dtype=float) for name, own in numbers.items()})
    decisive = [name for name in columns if name in ("lost", "stuck", "time", "missed")]
    columns = columns.dropna(subset=decisive)
    laws = [law for law in tables.contenders if law in columns.index]
    rows = columns.loc[laws].reset_index(drop=True)
    operations = [tables.simplicity(law)[1] for law in laws]
    facts = [find_facts(tables.contenders[law]) for law in laws]
    return rows.assign(contender=laws, situation=OF_RUN, operations=operations, **{FACTS: facts})


def tabulate_pairs(pairs: list[dict]) -> pd.DataFrame:
    """Return comparisons of two laws as a table, also where there are none."""
    return pd.DataFrame(pairs, columns=["law", "other", "starts", "log_ratio", "error", "low", "high"])


@functools.cache
def compare_run(folder: Path) -> Compared:
    """Return the laws of the free body of the run in a folder."""
    return compare_free_body(Run(folder))


def settles_everywhere(rows: pd.DataFrame) -> pd.Series:
    """Tell which laws settle from every start of the free body of a run, without unwinding."""
    return (rows["lost"] == 0) & (rows["directed"] == 0) & (rows["detour"] < DETOUR)


def is_unheld(rows: pd.DataFrame) -> pd.Series:
    """Tell which laws no worst-case noise up to HELD_RAD traps at a 180° rotation."""
    return rows["held"] > HELD_RAD
