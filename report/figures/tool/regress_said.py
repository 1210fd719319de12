"""What the page on regressions says in numbers, a paragraph each; if the study has not been run, that."""

from __future__ import annotations

from typing import Any

import pandas as pd

from bench.regression.revisions import alternating, instructions, rule
from bench.regression.revisions.target import LEVEL
from bench.studies.gates import power
from report.figures.kit.html import Markdown
from report.figures.kit.spelling import power as in_powers
from report.figures.tool.regress_rows import NOT_RUN

TENTH = 0.10


def numbers() -> dict[str, Any]:
    """Those of the rule itself."""
    return {
        "p": rule.P,
        "ratio": f"{rule.RATIO:.2f}",
        "rounds": alternating.ROUNDS,
        "tolerance": f"{100 * instructions.TOLERANCE:g} %",
        "level": LEVEL,
    }


def lead(verdicts: pd.DataFrame, faults: list[dict[str, Any]]) -> Markdown:
    """Both figures: false alarms, and faults found."""
    said = []
    if len(verdicts):
        alarms = verdicts.groupby("comparison")["alarm"].any()
        said.append(
            f"Same code against itself, {len(alarms)} times on a busy machine: {int(alarms.sum())} false alarms."
        )
    if planted := [one for one in faults if one["law"]]:
        named = sum(one["caught"] and one["named"] for one in planted)
        said.append(f"Of {len(planted)} planted faults {named} are caught and named.")
    return Markdown(" ".join(said) or f"{NOT_RUN}.")


def noise(verdicts: pd.DataFrame, apart: pd.Series) -> Markdown:
    """How far apart the same code was, and what each condition of the rule took away."""
    if verdicts.empty:
        return Markdown(f"{NOT_RUN}.")
    comparisons = verdicts.groupby("comparison")
    alone = comparisons["p"].min() < rule.P
    said = [
        f"{len(comparisons)} comparisons of {verdicts['benchmark'].nunique()} benchmarks, beside up to "
        f"{verdicts['neighbours'].max()} busy processes of the study's own. The {len(verdicts)} ratios go from "
        f"{verdicts['ratio'].min():.2f} to {verdicts['ratio'].max():.2f}. By p alone {int(alone.sum())} comparisons "
        f"would have rung; both conditions held for {int(verdicts['doubted'].sum())} benchmarks in "
        f"{int(comparisons['doubted'].any().sum())} of them, and the second run confirmed "
        f"{int(verdicts['alarm'].sum())}. No machine code was taken to be as fast because it is the same."
    ]
    if len(apart):
        said.append(
            f"Counts of instructions, {len(apart)} pairs, differed by {in_powers(float(apart.abs().max()))} at most."
        )
    return Markdown(" ".join(said))


def found(steps: pd.DataFrame) -> Markdown:
    """What a tenth more time looks like, and from where on each gate is sure."""
    if steps.empty:
        return Markdown(f"{NOT_RUN}.")
    near = steps.iloc[(steps["slower"] - TENTH).abs().argmin()]
    said = [
        f"`{power.LAW}`, {steps['repeats'].iloc[0]} comparisons a step. What is {100 * near['slower']:.0f} % slower is "
        f"found in {100 * near['once']:.0f} % of single runs and in {100 * near['twice']:.0f} % of pairs of runs; it "
        f"has {100 * near['instructions']:.1f} % more instructions."
    ]
    for words, which in (
        ("Time is sure", (steps["twice"] == 1.0) & (steps["slower"] > 0.0)),
        ("Instructions tell", steps["instructions"] > instructions.TOLERANCE),
    ):
        if which.any():
            said.append(f"{words} from {100 * steps.loc[which, 'slower'].min():.0f} % on.")
    return Markdown(" ".join(said))
