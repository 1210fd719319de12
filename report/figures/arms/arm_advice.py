"""What the run advises: which law, which inverse; and how often the paper's two ways to command angles end alike."""

from __future__ import annotations

import pandas as pd

from bench.findings.claims.verdict import NoEvidence
from bench.findings.on_arms import best
from bench.findings.selection import needs
from report.figures.arms import arm_ranking, arm_rows
from report.figures.kit import families
from report.figures.kit.page import ABSENT, Run

NOT_TOLD = "none, for this run does not tell"

FEWEST = 2
"""Ways to choose between: with fewer there is no choice to advise on."""


def advised(run: Run) -> str:
    """The law that is advised for an arm (`selection.needs`)."""
    try:
        law = needs.advice(run.folder).of(needs.ARM).law
    except NoEvidence:
        return NOT_TOLD
    return families.word(law) if law else NOT_TOLD


def same_both_ways(rows: pd.DataFrame) -> str | None:
    """How many episodes of the Euler law end alike by (2.2) with (2.15) and by (3.7)."""
    pair = [arm_rows.of(rows, controller) for controller in (arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)]
    both = pair[0].merge(pair[1], on=["arm", "start_set", "start_id"])
    if both.empty:
        return None
    alike = int((both["outcome_x"] == both["outcome_y"]).sum())
    return f"{alike} of {len(both)}"


def in_words(way: str) -> str:
    """The title of a way's inverse inside a sentence."""
    title = arm_rows.title_of_inverse(way.partition("+")[2])
    return title[:1].lower() + title[1:]


def inverses(rows: pd.DataFrame) -> str:
    """Which inverse is best within torque and range from evenly spread starts, by the law that is run with most."""
    own = rows[(rows["start_set"] == "uniform") & (rows["controller"] == arm_rows.ON_MATRIX)]
    if own["way"].nunique() < FEWEST:
        return f"Which inverse is best is {ABSENT}."
    names = best(own, "range", "way")
    share = arm_ranking.told(own.assign(controller=own["way"]), names[0], "range")
    led = ", ".join(f"“{in_words(name)}”" for name in names)
    how = f"tie, at up to {share}" if len(names) > 1 else f"leads: {share}"
    return f"Of the inverses, all with the rotation matrix, {led} {how}."
