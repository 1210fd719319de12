"""Laws with other values of the constants that are ours: what each value does to their times and ranks."""

import math
from collections.abc import Iterator
from typing import Any

from bench.findings.constants import CONSTANTS, Constant, Varied, default_times, describe, read_rows, vary
from bench.findings.selection.regions import find_default
from report.figures.kit import families, html
from report.figures.kit.page import Run
from report.figures.kit.spelling import listed

TABLE = html.Table(
    "Law | Constant | As shipped | Other values | Ratio of times as shipped:.2f | Ratio with other values | "
    "Rank as shipped | Rank with other values",
    words=("As shipped",),
)


def facts(_: Run) -> dict[str, Any]:
    """Return the table, how many situations it is made of, and which laws one value does not rank."""
    rows, default = read_rows(), find_default()
    varied = {constant: vary(constant, rows, default) for constant in CONSTANTS}
    moved = [constant.law for constant, every in varied.items() if len({one.rank for one in every}) > 1]
    times = default_times(rows, default)
    return {
        "default": families.word(default),
        "situations": rows["situation"].nunique(),
        "usable": int(times.map(math.isfinite).sum()),
        "starts": int(rows["starts"].max()),
        "laws": rows["regulator"].nunique(),
        "moved": listed([families.word(law) for law in dict.fromkeys(moved)]) if moved else "no law",
        "table": TABLE(make_rows(varied)),
    }


def make_rows(varied: dict[Constant, list[Varied]]) -> Iterator[tuple]:
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
    return " ".join(describe(one, vary(one, rows, default), default) for one in CONSTANTS if one.law == law)


def _span(ordered: list[str]) -> str:
    """Return the first and the last of some numbers, or the one that all are."""
    first, last = ordered[0], ordered[-1]
    return first if first == last else f"{first} to {last}"
