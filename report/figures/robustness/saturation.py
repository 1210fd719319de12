"""The page on a bound on the command."""

from __future__ import annotations

import pandas as pd

from bench.findings.selection.measured import measured
from bench.findings.selection.words import leaders
from bench.findings.theory import robustness_theory
from report.figures.kit import families
from report.figures.kit.page import Run, in_run
from report.figures.robustness.rows import DEG, along, laws, losses, medians, with_unit
from tasks.rules import RULES

NAME = "saturation"


def bounded(run: Run) -> pd.DataFrame:
    """Return rows with `over_least`: settling time over the least that the bound allows from that angle."""
    rows = along(run, NAME)
    least = [
        robustness_theory.least_settling(angle, bound, RULES.tolerance)
        for angle, bound in zip(rows["angle0_rad"], rows["level"], strict=True)
    ]
    return rows.assign(over_least=rows["time_s"] / least)


def facts(run: Run) -> dict:
    """Return which laws come near the least time, and who overshoots."""
    rows = bounded(run)
    table = medians(rows, "over_least")
    kept = rows[rows["contender"].isin(laws(rows, controls=False))]
    best, tight = kept.loc[kept["over_least"].idxmin()], min(table.index)
    overshoot = medians(rows, "overshoot_rad").loc[tight]
    return {
        "worst": with_unit(tight, NAME),
        "losses": losses(rows, NAME),
        "record": f"{best['over_least']:.3f}",
        "record_law": families.word(str(best["contender"])),
        "record_bound": with_unit(float(best["level"]), NAME),
        "tight": f"{table.loc[tight].min():.2f}",
        "tight_law": in_run(fastest, run) or "none, for this run does not compare laws",
        "slack": f"{table.loc[tight].max():.2f}",
        "over_law": families.word(overshoot.idxmax()),
        "over": f"{DEG * overshoot.max():.0f}",
    }


def fastest(run: Run) -> str:
    """Return the laws that none beats behind the tightest bound."""
    return leaders(measured(run.folder), "bounded", families.word)
