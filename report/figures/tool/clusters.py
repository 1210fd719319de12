"""The page on clusters: what very many episodes cost. Read from results/scale, which is committed."""

from __future__ import annotations

import functools
from typing import Any

import pandas as pd

from bench.experiments.choice import MOST_STARTS
from bench.files import read_json
from bench.running.schedulers.words import THREADS
from bench.tables.schema import RESULTS
from report.figures.kit.html import number
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table

FILE = RESULTS / "scale" / "scale.json"
FEW, MANY = 10**4, 10**6
"""Episodes of the two runs that are held against each other."""

TENTH = 0.10
"""What an episode of many may cost more than one of few."""

FLAT = 0.25
"""What memory may grow by and be called flat, for a hundred times the episodes."""

STUDY = 10**9
"""Episodes of the study that is reckoned."""

CORES = 1000

MEASURED = ["scheduler", "episodes", "cpu_s", "own_cpu_s", "wall_s", "others", "peak_bytes", "row_bytes", "rows"]

COST = "CPU an episode [µs]"
SIZES = Table(f"Episodes | Runs | {COST}:.0f | Least to most | Peak memory [MB]:.0f | Rows on disk [B an episode]:.0f")


@functools.cache
def study() -> dict[str, Any]:
    """All that was measured, part by part; empty if nothing was."""
    return read_json(FILE) if FILE.is_file() else {}


def sizes(found: dict[str, Any]) -> pd.DataFrame:
    """By number of episodes, from few to many: over its runs the median, and the least and most of their cost."""
    runs = pd.DataFrame(found.get("sizes", []), columns=MEASURED)
    runs["each_us"] = 1e6 * runs["cpu_s"] / runs["episodes"]
    by = runs.groupby("episodes")
    cost = by["each_us"].agg(runs="size", each_us="median", least_us="min", most_us="max")
    return cost.join(by[["peak_bytes", "row_bytes"]].median())


def schedulers(found: dict[str, Any]) -> pd.DataFrame:
    """A row a scheduler, one thread first.

    Columns of MEASURED, and processes; by_wall, the efficiency, one thread's time over that of all processes.
    """
    rows = pd.DataFrame(found.get("schedulers", []), columns=MEASURED)
    alone = rows.iloc[:1].squeeze()
    rows["processes"] = [1 if one == THREADS else int(one.partition(":")[2]) for one in rows["scheduler"]]
    rows["by_wall"] = alone["wall_s"] / (rows["processes"] * rows["wall_s"])
    return rows


def tables_apart(found: dict[str, Any]) -> list[str]:
    """Names of tables whose bytes depend on the scheduler, or on a worker that was killed."""
    digests = pd.DataFrame(found["killed"]["tables"])
    return list(digests.index[digests.nunique(axis=1, dropna=False) > 1])


def facts(_: Run) -> dict:
    """A paragraph each."""
    return text(study())


def text(found: dict[str, Any]) -> dict:
    """Those paragraphs whose part of the study was run."""
    size, by = sizes(found), schedulers(found)
    words: dict = {"same": same(found)} if "killed" in found else {}
    if {FEW, MANY} <= set(size.index):
        words |= {"cost": cost(found, size), "memory": memory(size)}
    if len(by):
        words["efficiency"] = efficiency(by)
    if len(size) and len(by):
        words["lead"] = (
            f"An episode on the ideal plant costs {size['each_us'].iloc[-1]:.0f} µs of a core, and {power(STUDY)} of "
            f"them {core_hours(size, by):.0f} core-hours."
        )
        words["study"] = of_many(size, by)
    return words


def same(found: dict[str, Any]) -> str:
    """Whether rows depend on who makes them, or on a worker that is lost."""
    apart, killed = tables_apart(found), found["killed"]
    count = len(next(iter(killed["tables"].values())))
    return (
        f"A plan of {killed['units']} units, on the free body, on an arm, in contact and perturbed, was run by "
        f"threads, by two processes, and by two of which {killed['killed']} was killed half way. "
        + (f"These tables differ: {', '.join(apart)}." if apart else f"All {count} tables have the same bytes.")
    )


def cost(found: dict[str, Any], size: pd.DataFrame) -> str:
    """What an episode of the largest run costs against one of 10^4, and how far that can be told."""
    few, many, about = size.loc[FEW], size.loc[MANY], found["provenance"]["sizes"]
    change = many["each_us"] / few["each_us"] - 1.0
    return (
        f"`{found['sizes'][0]['law']}` on uniform starts on the ideal plant, by one thread ({about['cpu']}, "
        f"{about['cores']} cores). In a run of {power(MANY)} an episode costs {many['each_us']:.0f} µs, in one of "
        f"{power(FEW)} {few['each_us']:.0f} µs: {_signed(change)}, "
        f"{'at most' if change <= TENTH else '**over**'} a tenth more. The {few['runs']:.0f} runs of "
        f"{power(FEW)}, before the largest and after it, lie between {few['least_us']:.0f} and {few['most_us']:.0f} µs."
    )


def memory(size: pd.DataFrame) -> str:
    """How the largest memory grows, with the same two runs."""
    few, many = size.loc[FEW], size.loc[MANY]
    change = many["peak_bytes"] / few["peak_bytes"] - 1.0
    more = (many["peak_bytes"] - few["peak_bytes"]) / (MANY - FEW)
    return (
        f"The process holds {few['peak_bytes'] / 1e6:.0f} MB at most in the one and {many['peak_bytes'] / 1e6:.0f} MB "
        f"in the other: {_signed(change)}, or {more:.0f} bytes for each episode more, whose row takes "
        f"{many['row_bytes']:.0f} on disk. Memory is {'flat' if change <= FLAT else '**not** flat'}, if a quarter more "
        "for a hundred times the episodes is."
    )


def efficiency(by: pd.DataFrame) -> str:
    """How much of the time of one process and of two goes into episodes, and how many one client keeps busy."""
    one, two = (by[by["processes"] == number].iloc[-1] for number in (1, 2))
    busy, own_us = two["cpu_s"] / two["own_cpu_s"] - 1.0, 1e6 * two["own_cpu_s"] / two["episodes"]
    return (
        f"{power(two['episodes'])} episodes each. Efficiency is one thread's time over that of all processes: by wall "
        f"time {100 * one['by_wall']:.0f} % with one process and {100 * two['by_wall']:.0f} % with two. Other programs "
        f"took {by['others'].max():.2f} cores at most meanwhile. The start of processes is left out. Of an episode's "
        f"CPU time with two, {own_us:.0f} µs are the client's, which gives out, writes and merges: one client "
        f"keeps some {busy:.0f} processes busy with episodes as cheap as these, and more with others."
    )


def of_many(size: pd.DataFrame, by: pd.DataFrame) -> str:
    """What very many episodes would cost, computed from what was measured."""
    hours, runs, last = core_hours(size, by), STUDY // MOST_STARTS, size.iloc[-1]
    return (
        f"At the cost of the largest run, and two processes' efficiency by wall time, {power(STUDY)} episodes take "
        f"{hours:.0f} core-hours: {60 * hours / CORES:.0f} minutes on {number(CORES)} cores if these are as efficient, "
        f"which was not measured. Rows take {STUDY * last['row_bytes'] / 1e9:.0f} GB. A run has at most "
        f"{power(MOST_STARTS)} starts of a set, so it is {number(runs)} runs, each with a seed (`--seed`), a folder "
        "and a client of its own."
    )


def core_hours(size: pd.DataFrame, by: pd.DataFrame) -> float:
    """Of STUDY, by the largest run's cost and the efficiency of the most processes."""
    return STUDY * 1e-6 * size["each_us"].iloc[-1] / by["by_wall"].iloc[-1] / 3600.0


def _signed(change: float) -> str:
    """A change in per cent, with its sign."""
    return f"{100 * change:+.0f} %".replace("-", "\N{MINUS SIGN}")


def tables(_: Run) -> dict:
    """What episodes cost by their number."""
    return {"tab_sizes": by_size(study())}


def by_size(found: dict[str, Any]):
    """A row a number of episodes: what one costs, and the memory of the whole run."""
    return SIZES(
        (
            power(one.Index),
            one.runs,
            one.each_us,
            f"{one.least_us:.0f} to {one.most_us:.0f}" if one.runs > 1 else None,
            one.peak_bytes / 1e6,
            one.row_bytes,
        )
        for one in sizes(found).itertuples()
    )
