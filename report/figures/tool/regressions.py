"""The page on the regression gate, read from results/regress, which is committed."""

from __future__ import annotations

import functools
from typing import Any

import pandas as pd

from bench.files import read_json
from bench.regression.revisions import alternating, instructions, rule
from bench.regression.revisions.comparison import SAME
from bench.regression.revisions.machine import LEVEL
from bench.studies.gates import power
from report.figures.kit import html
from report.figures.kit.page import Run, given
from report.figures.kit.spelling import power as in_powers
from report.figures.kit.tables import Table

TENTH = 0.10

FAULTS = Table("Planted | In | Caught by | In the words")


@functools.cache
def part(run: Run, name: str) -> list[dict[str, Any]]:
    """The rows of same_code, power or faults; none if it has not been run."""
    path = run.studies / "regress" / f"{name}.json"
    return read_json(path)["rows"] if path.is_file() else []


def verdicts(run: Run) -> pd.DataFrame:
    """A row for each benchmark of each comparison of the same code.

    Columns: comparison, neighbours (busy processes), benchmark, ratio and p of the first run, `doubted` (its verdict
    was not "same") and `alarm` (a second run agreed).
    """
    rows = [
        {
            "comparison": number,
            "neighbours": sum(one["load"].values()),
            "benchmark": name,
            "ratio": timed["ratio"],
            "p": timed["p"],
            "doubted": name in one["doubted"],
            "alarm": name in one["doubted"] and one["doubted"][name]["verdict"] != SAME,
        }
        for number, one in enumerate(part(run, "same_code"), start=1)
        for name, timed in one["timed"].items()
    ]
    return pd.DataFrame(rows)


def counts_apart(run: Run) -> pd.Series:
    """Instructions of the same code, head over base - 1; one for each law of each comparison that counted them."""
    return pd.Series(
        [apart for one in part(run, "same_code") for apart in (one["instructions"] or {}).values()], dtype=float
    )


def steps(run: Run) -> pd.DataFrame:
    """A row for each planted step: how much slower, the shares found by one run and by two, and more instructions."""
    found = pd.DataFrame([one for one in part(run, "power") if one["instructions"]])
    if found.empty:
        return found
    base, head = (found["instructions"].str[side] for side in (0, 1))
    shares = {name: found[name] / found["repeats"] for name in ("once", "twice")}
    return found.assign(instructions=head / base - 1.0, **shares).sort_values("slower", ignore_index=True)


def facts(run: Run) -> dict:
    """The rule's numbers, and a paragraph each on false alarms, faults, the same code and slower code."""
    return {
        "p": rule.P,
        "ratio": f"{rule.RATIO:.2f}",
        "rounds": alternating.ROUNDS,
        "tolerance": f"{100 * instructions.TOLERANCE:g} %",
        "level": LEVEL,
        "lead": given(verdicts(run), lambda rows: lead(rows, part(run, "faults"))),
        "noise": given(verdicts(run), lambda rows: noise(rows, counts_apart(run))),
        "found": given(steps(run), found),
    }


def lead(rows: pd.DataFrame, faults: list[dict[str, Any]]) -> str:
    """Both figures: false alarms, and faults found."""
    alarms = rows.groupby("comparison")["alarm"].any()
    planted = [one["caught"] and one["named"] for one in faults if one["law"]]
    return (
        f"Same code against itself, {len(alarms)} times on a busy machine: {int(alarms.sum())} false alarms. "
        f"Of {len(planted)} planted faults {sum(planted)} are caught and named."
    )


def noise(rows: pd.DataFrame, apart: pd.Series) -> str:
    """How far apart the same code was, and what each condition of the rule took away."""
    comparisons = rows.groupby("comparison")
    alone = comparisons["p"].min() < rule.P
    words = (
        f"{len(comparisons)} comparisons of {rows['benchmark'].nunique()} benchmarks, beside up to "
        f"{rows['neighbours'].max()} busy processes of the study's own. The {len(rows)} ratios go from "
        f"{rows['ratio'].min():.2f} to {rows['ratio'].max():.2f}. By p alone {int(alone.sum())} comparisons "
        f"would have rung; both conditions held for {int(rows['doubted'].sum())} benchmarks in "
        f"{int(comparisons['doubted'].any().sum())} of them, and the second run confirmed "
        f"{int(rows['alarm'].sum())}. No machine code was taken to be as fast because it is the same."
    )
    if len(apart):
        most = in_powers(float(apart.abs().max()))
        words += f" Counts of instructions, {len(apart)} pairs, differed by {most} at most."
    return words


def found(rows: pd.DataFrame) -> str:
    """What a tenth more time looks like, and from where on each gate is sure."""
    near = rows.iloc[(rows["slower"] - TENTH).abs().argmin()]
    words = (
        f"`{power.LAW}`, {rows['repeats'].iloc[0]} comparisons a step. What is {100 * near['slower']:.0f} % slower is "
        f"found in {100 * near['once']:.0f} % of single runs and in {100 * near['twice']:.0f} % of pairs of runs; it "
        f"has {100 * near['instructions']:.1f} % more instructions."
    )
    for who, which in (
        ("Time is sure", (rows["twice"] == 1.0) & (rows["slower"] > 0.0)),
        ("Instructions tell", rows["instructions"] > instructions.TOLERANCE),
    ):
        if which.any():
            words += f" {who} from {100 * rows.loc[which, 'slower'].min():.0f} % on."
    return words


def tables(run: Run) -> dict:
    """What was planted, which gates caught it, and in what words; what has no law is caught by nothing."""
    return {"tab_faults": FAULTS(map(fault, part(run, "faults")))}


def fault(one: dict[str, Any]) -> tuple:
    """A line of the table."""
    words = html.foreign(one["says"][0]) if one["says"] else html.MISSING
    return one["fault"], one["law"] or html.MISSING, ", ".join(one["gates"]) or "nothing", words
