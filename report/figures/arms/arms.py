"""The page on arms: the arms, their starts, which controllers settle within an arm's limits, the pole, the wrist."""

from __future__ import annotations

import functools
import sys
from collections.abc import Iterator

import numpy as np
import pandas as pd

import tasks
from bench.findings.selection import needs
from report.figures.arms import arm_pole, arm_ranking, arm_rows
from report.figures.arms.arm_rows import STANDARD
from report.figures.kit import families, html
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import prose
from report.figures.kit.tables import Table
from tasks.cause import NEAR_CONDITION, NEAR_MARGIN
from tasks.kinematics import kinematics
from tasks.paths import zyx_angles

ARMS = Table("Arm | Maker's name | Joints | Condition:.1f | β [deg] | Rated torques [N m]")
STARTS = Table("Set | What it is for | Starts an arm | Horizon [s]")
POLE = Table("Arm | Starts | (2.2) fails | (3.7) fails | fails or hammers | Way:.1f | Torque")
WRIST = Table("Controller | Inverse | Starts | Settled [%]:.0f | Strays [mm] | 95 % | Torque")


@functools.cache
def standard(run: Run) -> pd.DataFrame:
    """Episodes by the paper's two Jacobians and the standard inverse."""
    return arm_rows.with_standard(arm_rows.episodes(run))


def facts(run: Run) -> dict:
    """Which law and inverse to take, what the pole, the arm's own singularities and torques do."""
    rows = arm_rows.episodes(run)
    both, laws = arm_pole.side_by_side(standard(run)), standard(run)
    causes = laws.loc[~arm_rows.settled(laws), "cause"]
    return {
        **arm_ranking.facts(rows),
        "advised": advised(run),
        "pole_n": len(both),
        "pole_fails": int(both["fails"].sum()),
        "pole_fails_m": int(both["fails_matrix"].sum()),
        "hammer": f"{arm_pole.HAMMERED:g}",
        "hammered": int(arm_pole.hammers(both).sum()),
        "near_margin": int((both["min_margin"] < NEAR_MARGIN).sum()),
        "cond": html.number(both["cond_jacobian_max"].median()),
        "cond_m": html.number(both["cond_jacobian_max_matrix"].median()),
        "margin": f"{NEAR_MARGIN:g}",
        "condition": f"{NEAR_CONDITION:g}",
        "both_ways": same_both_ways(rows),
        "possible": f"{100.0 * float((laws['peak_torque_ratio'] <= 1.0).mean()):.0f}",
        "kinematic": int((causes == "kinematic").sum()),
        "failures": len(causes),
    }


def tables(run: Run) -> dict:
    """Return tables of arms and starts, which controllers settle within the arm's limits, the pole, and the wrist."""
    return {
        "tab_arms": ARMS(map(arm_row, tasks.arm_names())),
        "sources": "\n".join(f"- `{name}`: {prose(tasks.arm(name).source)}" for name in tasks.arm_names()),
        "tab_starts": in_run(lambda: STARTS(start_sets(arm_rows.episodes(run)))),
        "tab_ranked": in_run(lambda: arm_ranking.table(arm_rows.episodes(run))),
        "tab_pole": in_run(lambda: POLE(at_the_pole(standard(run)))),
        "tab_wrist": in_run(lambda: WRIST(at_the_wrist(arm_rows.episodes(run)))),
    }


def figures(run: Run) -> dict:
    """Draw rotations that pass the pole."""
    return {"arm-pole": arm_pole.pole(standard(run))}


def arm_row(name: str) -> tuple:
    """Return an arm: joints, its Jacobian's condition number and the tool's beta at home, torques."""
    one = tasks.arm(name)
    model = kinematics(one)
    beta = round(float(np.degrees(zyx_angles(model.pose(one.home)[1])[1]))) + 0
    rated = ", ".join(f"{torque:g}" for torque in one.rated)
    named = html.together(f"`{name}`"), prose(one.title)
    return *named, one.joints, model.condition(one.home), beta, rated


def start_sets(rows: pd.DataFrame) -> Iterator[tuple]:
    """Every set: what its module says of it first, its starts on each arm of the run, its horizon."""
    for name in arm_rows.SETS:
        mine = rows[rows["start_set"] == name]
        tasks.start_set_title(name, arm=True)  # reads the module
        counts = mine.groupby("arm")["start_id"].nunique()
        starts = f"{counts.min()}" if counts.nunique() == 1 else f"{counts.min()} to {counts.max()}"
        summary = prose(first_paragraph(f"tasks.arm_starts.{name.replace('-', '_')}"))
        horizon = float(mine["horizon_s"].max()) if len(mine) else None
        yield html.together(f"`{name}`"), summary, starts if len(counts) else "none", horizon


def first_paragraph(module: str) -> str:
    """Return the summary of a module's docstring."""
    return " ".join((sys.modules[module].__doc__ or "").partition("\n\n")[0].split())


def at_the_pole(rows: pd.DataFrame) -> Iterator[tuple]:
    """Arm by arm: failures of both, way travelled over the shortest, peak torque of one over the other's."""
    for arm, own in arm_pole.side_by_side(rows).groupby("arm"):
        fails = int(own["fails_matrix"].sum()), int(own["fails"].sum()), int(arm_pole.hammers(own).sum())
        yield arm, len(own), *fails, own.loc[~own["fails"], "path_ratio"].median(), own["harder"].median()


def at_the_wrist(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return by controller and inverse: starts, share that settles, how far the tool strays, torque over rated."""
    starts = rows[(rows["start_set"] == "wrist") & rows["controller"].isin(arm_rows.PAPERS_TWO)]
    ways = [(*way.split("+"), own) for way, own in starts.groupby("way")]
    for controller, inverse, own in sorted(ways, key=lambda one: (one[0] != arm_rows.ON_MATRIX, one[1] != STANDARD)):
        strays = 1e3 * own["position_error_m"]
        named = arm_rows.title(controller), arm_rows.title_of_inverse(inverse), len(own)
        measured = strays.median(), strays.quantile(0.95), own["peak_torque_ratio"].median()
        yield *named, 100.0 * arm_rows.settled(own).mean(), *measured


def advised(run: Run) -> str:
    """Return the law that is advised for an arm (`selection.needs`)."""
    law = in_run(lambda: needs.advice(run.folder).of(needs.ARM).law)
    return families.word(law) if law else "none, for this run does not tell"


def same_both_ways(rows: pd.DataFrame) -> str | None:
    """How many episodes of the Euler law end alike by (2.2) with (2.15) and by (3.7)."""
    pair = [arm_rows.of(rows, controller) for controller in (arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)]
    both = pair[0].merge(pair[1], on=["arm", "start_set", "start_id"])
    if both.empty:
        return None
    alike = int((both["outcome_x"] == both["outcome_y"]).sum())
    return f"{alike} of {len(both)}"
