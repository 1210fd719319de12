"""What the page on clusters says in numbers, a paragraph each; if the study has not been run, that."""

from __future__ import annotations

from typing import Any

import pandas as pd

from bench.experiments import arm, contact, free_body
from bench.experiments.choice import MOST_STARTS
from report.figures.kit.html import Markdown, number
from report.figures.kit.spelling import power
from report.figures.tool.clusters_rows import FEW, MANY, NOT_RUN, rows_are_same, tables_apart

TENTH = 0.10
"""What an episode of many may cost more than one of few."""

FLAT = 0.25
"""What memory may grow by and be called flat, for a hundred times the episodes."""

QUIET = 0.1
"""Cores that other programs may take and leave wall times what they are."""

STUDY = 10**9
"""Episodes of the study that is reckoned."""

CORES = 1000


def lead(sizes: pd.DataFrame, schedulers: pd.DataFrame) -> Markdown:
    """What one episode costs, and what very many do."""
    if sizes.empty or schedulers.empty:
        return Markdown(f"{NOT_RUN}.")
    each_us = sizes["each_us"].iloc[-1]
    return Markdown(
        f"An episode on the ideal plant costs {each_us:.0f} µs of a core, and {power(STUDY)} of them "
        f"{core_hours(sizes, schedulers):.0f} core-hours."
    )


def same(found: dict[str, Any]) -> Markdown:
    """Whether rows hang on who makes them, or on a worker that is lost."""
    if "killed" not in found:
        return Markdown(f"{NOT_RUN}.")
    apart, killed = tables_apart(found), found["killed"]
    tables = len(next(iter(killed["tables"].values())))
    said = (
        f"A plan of {killed['units']} units, on the free body, on an arm, in contact and in trouble, was run by "
        f"threads, by two processes, and by two of which {killed['killed']} was killed half way. "
    )
    said += f"These tables differ: {', '.join(apart)}." if apart else f"All {tables} tables have the same bytes."
    if not rows_are_same(found):
        said += " Of the runs below, some of as many episodes have other rows."
    return Markdown(said)


def cost(found: dict[str, Any], sizes: pd.DataFrame) -> Markdown:
    """What an episode of the largest run costs against one of 10^4, and how far that can be told."""
    few, many = (sizes[sizes["episodes"] == number] for number in (FEW, MANY))
    if few.empty or many.empty:
        return Markdown(f"{NOT_RUN}.")
    few, many, about = few.iloc[0], many.iloc[0], found["provenance"]["sizes"]
    change = many["each_us"] / few["each_us"] - 1.0
    return Markdown(
        f"`{found['sizes'][0]['law']}` on uniform starts on the ideal plant, by one thread ({about['cpu']}, "
        f"{about['cores']} cores). In a run of {power(many['episodes'])} an episode costs {many['each_us']:.0f} µs, in "
        f"one of {power(few['episodes'])} {few['each_us']:.0f} µs: {signed(change)}, "
        f"{'within' if abs(change) <= TENTH else '**not** within'} a tenth. The {few['runs']:.0f} "
        f"runs of {power(few['episodes'])}, before the largest and after it, lie between {few['least_us']:.0f} and "
        f"{few['most_us']:.0f} µs."
    )


def memory(sizes: pd.DataFrame) -> Markdown:
    """How the largest memory grows, with the same two runs."""
    few, many = (sizes[sizes["episodes"] == number] for number in (FEW, MANY))
    if few.empty or many.empty:
        return Markdown(f"{NOT_RUN}.")
    few, many = few.iloc[0], many.iloc[0]
    change = many["peak_bytes"] / few["peak_bytes"] - 1.0
    more = (many["peak_bytes"] - few["peak_bytes"]) / (many["episodes"] - few["episodes"])
    return Markdown(
        f"The process holds {few['peak_bytes'] / 1e6:.0f} MB at most in the one and {many['peak_bytes'] / 1e6:.0f} MB "
        f"in the other: {signed(change)}, or {more:.0f} bytes for each episode more, whose row takes "
        f"{many['row_bytes']:.0f} on disk. Memory is {'flat' if change <= FLAT else '**not** flat'}, if a quarter more "
        "for a hundred times the episodes is."
    )


def efficiency(schedulers: pd.DataFrame) -> Markdown:
    """How much of the time of one process and of two goes into episodes, and how many one client keeps busy."""
    if schedulers.empty:
        return Markdown(f"{NOT_RUN}.")
    one, two = (schedulers[schedulers["processes"] == number].iloc[-1] for number in (1, 2))
    others = schedulers["others"].max()
    busy = (
        f"Other programs took {others:.2f} cores at most meanwhile"
        f"{'' if others <= QUIET else ', so that wall times are longer than they need be'}."
    )
    return Markdown(
        f"{power(two['episodes'])} episodes each. Efficiency is one thread's time over that of all processes: by wall "
        f"time {100 * one['by_wall']:.0f} % with one process and {100 * two['by_wall']:.0f} % with two. {busy} The "
        f"start of the processes is left out. Of an episode's CPU time with two, {two['own_us']:.0f} µs are the "
        f"client's, which gives out, writes and merges: one client keeps some {busy_processes(two):.0f} processes busy "
        "with episodes as cheap as these, and more with others."
    )


def study(sizes: pd.DataFrame, schedulers: pd.DataFrame) -> Markdown:
    """What very many episodes would cost, computed from what was measured."""
    if sizes.empty or schedulers.empty:
        return Markdown(f"{NOT_RUN}.")
    hours, runs = core_hours(sizes, schedulers), STUDY // MOST_STARTS
    return Markdown(
        f"At the cost of the largest run, and two processes' efficiency by wall time, {power(STUDY)} episodes take "
        f"{hours:.0f} core-hours: {60 * hours / CORES:.0f} minutes on {number(CORES)} cores if these are as efficient, "
        f"which was not measured. Rows take {STUDY * sizes['row_bytes'].iloc[-1] / 1e9:.0f} GB. A run has at most "
        f"{power(MOST_STARTS)} starts of a set, so it is {number(runs)} runs, each with a seed (`--seed`), a folder "
        f"and a client of its own. {dearer(sizes)}"
    )


def dearer(sizes: pd.DataFrame) -> str:
    """How much more other episodes cost."""
    each_s = 1e-6 * sizes["each_us"].iloc[-1]
    native, on_arm, in_contact = (
        number(float(f"{one / each_s:.1g}"))
        for one in (free_body.EPISODE_S["native"], arm.EPISODE_S["native"], contact.TRIAL_S)
    )
    return (
        f"In MuJoCo an episode costs some {native} times as much, on an arm {on_arm} times, in contact {in_contact} "
        "times."
    )


def core_hours(sizes: pd.DataFrame, schedulers: pd.DataFrame) -> float:
    """Of STUDY, by the largest run's cost and the efficiency of the most processes."""
    return STUDY * 1e-6 * sizes["each_us"].iloc[-1] / schedulers["by_wall"].iloc[-1] / 3600.0


def busy_processes(row: pd.Series) -> float:
    """How many make episodes as fast as one client can take them."""
    return (row["each_us"] - row["own_us"]) / row["own_us"]


def signed(change: float) -> str:
    """A change in per cent, with its sign."""
    return f"{100 * change:+.0f} %".replace("-", "\N{MINUS SIGN}")
