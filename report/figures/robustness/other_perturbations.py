"""Perturbations under which the linear loop near the goal decides, a bound on the command, goal streams."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

import tasks
from bench.findings.selection.measured import measured
from bench.findings.selection.words import leaders
from bench.findings.theory import robustness_theory
from report.figures.kit import families
from report.figures.kit.page import Run, in_run
from report.figures.robustness.rows import along, gains, medians, nominal, with_unit, worst
from tasks.goal_stream import PERIOD_S
from tasks.rules import RULES

TIMED = ("control-rate", "delay", "inertia", "uneven-inertia", "spin")
"""Perturbations under which laws settle."""

BOUND = "saturation"


def change(rows: pd.DataFrame, name: str) -> str:
    """Say by how much median settling times change at the worst level, and for which law most."""
    table, last = medians(rows), worst(rows, name)
    ratio = table.loc[last] / table.loc[nominal(name)]
    ratio = 100.0 * (ratio[np.isfinite(ratio)] - 1.0)
    if ratio.empty:
        return f"{tasks.axis(name).title.lower()}, {with_unit(last, name)}: no law settles"
    least, most = (f"{round(value):+d}".replace("-", "−") for value in (ratio.min(), ratio.max()))
    title = tasks.axis(name).title.lower()
    return f"{title}, {with_unit(last, name)}: {least} to {most} %, the most for {families.word(ratio.idxmax())}"


def timed(run: Run) -> dict[str, str]:
    """Return the margins of the linear loop, and changes of settling times."""
    kp, kv = gains(along(run, TIMED[0]))
    return {
        "limit": f"{robustness_theory.least_rate(kp, kv):g}",
        "margin_ms": f"{1000.0 * robustness_theory.delay_margin(kp, kv):.0f}",
        "changes": "; ".join(change(along(run, name), name) for name in TIMED),
    }


def bounded(run: Run) -> pd.DataFrame:
    """Return rows with `over_least`: settling time over the least that the bound allows from that angle."""
    rows = along(run, BOUND)
    pairs = zip(rows["angle0_rad"], rows["level"], strict=True)
    least = [robustness_theory.least_settling(angle, bound, RULES.tolerance) for angle, bound in pairs]
    return rows.assign(over_least=rows["time_s"] / least)


def saturated(run: Run) -> dict[str, str]:
    """Return how near the laws come to the least time behind the tightest bound, and which are the fastest there."""
    table = medians(bounded(run), "over_least")
    tight = min(table.index)
    fastest = in_run(lambda: leaders(measured(run.folder), "bounded", families.word))
    return {
        "bound": with_unit(tight, BOUND),
        "tight": f"{table.loc[tight].min():.2f}",
        "slack": f"{table.loc[tight].max():.2f}",
        "tight_law": fastest or "none, for this run does not compare laws",
    }


def streamed(run: Run) -> dict[str, str]:
    """Return the worst of the filters of goals, and of the quaternion taken as it came."""
    rows = run.rows("goal-streams").astype({"stream": str, "law": str})
    swept, raw = rows[(rows["law"] != "") & (rows["stream"] != "held")], rows[rows["law"] == ""]
    return {
        "worst_rate": f"{swept['goal_rate_ratio'].max():.0f}",
        "period": f"{1000 * PERIOD_S:g}",
        "raw_way": f"{raw['way_ratio'].max():.1f}",
        "raw_off": f"{math.degrees(raw['off_rad'].max()):.0f}",
    }


def facts(run: Run) -> dict:
    """Return the facts of every section whose rows the run has."""
    found: dict = {}
    for section in (timed, saturated, streamed):
        found |= in_run(section, run) or {}
    return found
