"""Laws with other values of the constants that are ours: what each value does to their times and ranks."""

import math
from collections.abc import Iterator
from typing import Any

import pandas as pd

from bench.experiments.tables.run import Run
from bench.findings.amounts import capitalize, join_words
from bench.findings.constants import (
    CONSTANTS,
    Constant,
    VariedConstant,
    default_times,
    read_rows,
    vary,
)
from bench.findings.selection.regions import find_default
from report.figures.kit import families, html

TABLE = html.PageTable(
    "Law | Constant | Value used | Other values tried "
    "| Settling time with the value used, divided by the settling time of the default law:.2f "
    "| Settling time with the other values, divided by the settling time of the default law "
    "| Rank of the law with the value used | Rank of the law with the other values",
    words=("Value used",),
)


def facts(_: Run) -> dict[str, Any]:
    """Return the table, how many situations it is made of, and which laws one value does not rank."""
    rows, default = read_rows(), find_default()
    varied = {constant: vary(constant, rows, default) for constant in CONSTANTS}
    moved = [constant.law for constant, every in varied.items() if len({one.rank for one in every}) > 1]
    return {
        "default": families.word(default),
        "situations": rows["situation"].nunique(),
        "usable": count_usable(rows, default),
        "starts": int(rows["starts"].max()),
        "laws": rows["regulator"].nunique(),
        "moved": join_words([families.word(law) for law in dict.fromkeys(moved)]) if moved else "no law",
        "table": TABLE(make_rows(varied)),
    }


def make_rows(varied: dict[Constant, list[VariedConstant]]) -> Iterator[tuple]:
    """Return a row a constant."""
    for constant, every in varied.items():
        [shipped] = [one for one in every if one.value == constant.shipped]
        others = [one for one in every if one.value != constant.shipped]
        yield (
            families.link(constant.law, families.word(constant.law)),
            constant.symbol,
            f"{constant.shipped:g}",
            ", ".join(f"{one.value:g}" for one in others),
            shipped.ratio,
            _span([f"{one.ratio:.2f}" for one in sorted(others, key=lambda one: one.ratio)]),
            f"{shipped.rank}",
            _span([f"{one.rank}" for one in sorted(others, key=lambda one: one.rank)]),
        )


def describe_constants(law: str) -> str:
    """Say of a law what its constants that are ours do; nothing of a law without such constants."""
    rows, default = read_rows(), find_default()
    laws, usable = rows["regulator"].nunique(), count_usable(rows, default)
    return " ".join(say(one, vary(one, rows, default), default, laws, usable) for one in CONSTANTS if one.law == law)


def count_usable(rows: pd.DataFrame, default: str) -> int:
    """Return in how many situations the body settles with the default law, so that a ratio to its time is known."""
    return int(default_times(rows, default).map(math.isfinite).sum())


def say(
    constant: Constant, every: list[VariedConstant], default: str, laws: int, usable: int
) -> str:
    """Say what the values of a constant do to the time of a law, and to its rank among so many laws.

    usable: the number of situations of which a ratio is the median.
    """
    values = sorted(one.value for one in every)
    ratios = [f"{one.ratio:.2f}" for one in sorted(every, key=lambda one: one.ratio)]
    word = families.word(default)
    beside = "its settling time with the value that we use" if constant.law == default else f"that of {word}"
    # a Greek symbol keeps its letter: Δ is another symbol than δ
    name = capitalize(constant.symbol) if constant.symbol[0].isascii() else constant.symbol
    ranks = [f"{one.rank}" for one in sorted(every, key=lambda one: one.rank)]
    return (
        f"{name}: we use {constant.shipped:g}, and we tried {len(values) - 1} other values between "
        f"{values[0]:g} and {values[-1]:g}. For each value we divided the settling time of the law by {beside}. We "
        f"took the median of this ratio over the {usable} situations in which the body settles with {word}. This "
        f"median is {_by_value(ratios)}. We also ranked the law by settling time among {laws} laws (rank 1 is the "
        f"fastest law). Its rank is {_by_value(ranks)}."
    )


def _by_value(ordered: list[str]) -> str:
    """Say what a number is for the values of a constant: the one that all have, or from the least to the greatest."""
    first, last = ordered[0], ordered[-1]
    return f"{first} for each value" if first == last else f"between {first} and {last}, depending on the value"


def _span(ordered: list[str]) -> str:
    """Return the first and the last of some numbers, or the one that all are."""
    first, last = ordered[0], ordered[-1]
    return first if first == last else f"{first} to {last}"
