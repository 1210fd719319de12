"""The page on tasks in contact: a plate, a peg, a crank and a plane, by controller and frame of the hand."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy.stats import fisher_exact

import tasks
from report.figures.contact.rows import CARTESIAN, EULER, PAPERS, PAPERS_EULER, of, of_task
from report.figures.kit import html, media
from report.figures.kit.page import ABSENT, NotInRun, Run, in_run
from report.figures.kit.tables import Table
from tasks.contact_rest import HORIZON_S, REST

P_VALUE = 0.05
"""P-value of Fisher's exact test, both sides: below it two shares of pegs differ significantly."""
SPRINGS = "impedance-geometric"
DEGREES = 180.0 / np.pi
LOOP = (
    "Two arms press a square tool onto a tilted plate. With Cartesian compliance the tool turns until it lies flat; "
    "with the Euler Jacobian it stays level, on one edge."
)

STILLS = (
    "Four renders of a PUMA 560 with a blue tool. A square tool flat on a tilted plate; a square peg in a leaning "
    "chamfered hole; a hand on a crank; a round tip on an inclined plane."
)


class Measure(NamedTuple):
    """A column of compliance.parquet: its words with the unit, the factor to it, and what a failed episode counts."""

    column: str
    title: str
    factor: float = 1.0
    failed: float = np.inf

    def of(self, rows: pd.DataFrame) -> str:
        """Return the median of the rows, of a share the mean; a dash where at least half of the episodes failed."""
        values = (rows[self.column] * self.factor).fillna(self.failed)
        value = values.mean() if "%" in self.title else values.median()
        return f"{value:.3g}" if np.isfinite(value) else html.MISSING


MEASURES = {
    "surface-alignment": Measure("alignment_error_rad", "tool to plate at the end [deg]", DEGREES),
    "peg-in-hole": Measure("jam", "not in at the end [%]", 100.0, 100.0),
    "crank": Measure("crank_angle_rad", "turned by [deg]", DEGREES, -np.inf),
    "force-on-plane": Measure("normal_force_error_n", "normal force, rms error [N]"),
}
"""Task -> the number that says how it went, the tasks whose orders free turns first."""

OUTCOMES = Table(
    "Task | Measured | Episodes | Cartesian | Euler Jacobian, level | Euler Jacobian, leaning most | Springs",
    words=("Cartesian", "Euler Jacobian, level", "Euler Jacobian, leaning most", "Springs"),
)


@functools.cache
def all_rows(run: Run) -> pd.DataFrame:
    """Return the rows of every task in contact that the run has."""
    found = [of_task(run, name) for name in MEASURES if len(run.any_rows("compliance", task=name))]
    if not found:
        raise NotInRun("no task in contact")
    return pd.concat(found, ignore_index=True)


def facts(run: Run) -> dict:
    """Return how episodes end, and what they are."""
    return describe_tasks() | (in_run(lambda: of_run(all_rows(run))) or {})


def describe_tasks() -> dict[str, str]:
    """Return what each task is, what its order lets comply, and when it ends."""
    arm = tasks.arm(media.facts()["contact"]["arm"])
    parts = [
        f"{task.title} (complies: {task.trials(arm)[0].specification.name})"
        for task in map(tasks.contact_task, MEASURES)
    ]
    return {
        "orders": f"{'. '.join(parts)}.",
        "rest_rule": f"{1e3 * REST.speed:g} mm/s and {REST.rate:g} rad/s for {REST.hold_s:g} s",
        "rest_horizon": f"{HORIZON_S:g}",
    }


def of_run(rows: pd.DataFrame) -> dict[str, str]:
    """Return what the run says."""
    return {
        **plate(rows),
        "betas": ", ".join(f"{beta:.0f}°" for beta in sorted(set(rows["beta_deg"]))),
        "flat": flat(rows),
        "stuck": stuck(rows, PAPERS, PAPERS_EULER),
        "other_stuck": stuck(rows, CARTESIAN, EULER),
    }


def plate(rows: pd.DataFrame) -> dict[str, str]:
    """Return what the loop shows, and the angles [deg] at the end of its two episodes."""
    about = media.facts()["contact"]
    shown, arm = about["plate"], tasks.arm(about["arm"])
    trial = next(one for one in tasks.contact_task(shown["task"]).trials(arm) if one.id == shown["trial"])
    own = rows[(rows["task"] == shown["task"]) & (rows["arm"] == about["arm"]) & (rows["pose"] == shown["trial"])]
    ends = np.degrees(own.set_index("contender")["alignment_error_rad"]).reindex(shown["controllers"])
    return {
        "plate_arm": arm.title,
        "plate_tilt": f"{np.degrees(trial.tilt):.0f}",
        "plate_force": f"{np.linalg.norm(trial.specification.desired_wrench[:3]):.0f}",
        "plate_beta": trial.id.rpartition("beta+")[2],
        **{word: f"{end:.1f}" for word, end in zip(("plate_cartesian", "plate_euler"), ends, strict=True)},
    }


def stuck(rows: pd.DataFrame, cartesian: str, euler: str) -> str:
    """How many pegs are not in at the end by both Jacobians, and whether they differ where the hand's frame leans."""
    own = rows[(rows["task"] == "peg-in-hole") & rows["contender"].isin((cartesian, euler))]
    if own.empty:
        return f"How pegs end is {ABSENT}."
    out = own.assign(out=own["jam"] != 0.0).groupby(["contender", own["beta_deg"] != 0.0])["out"]
    lost, n = out.sum().unstack(fill_value=0), out.size().unstack(fill_value=0)
    counts = [
        f"{who} {lost.loc[name].sum()} of {n.loc[name].sum()} ({lost.loc[name, True]} of {n.loc[name, True]} where the "
        "hand's frame leans)"
        for name, who in ((cartesian, "with Cartesian compliance"), (euler, "on the Euler Jacobian"))
    ]
    p_value = fisher_exact([[lost.loc[name, True], (n - lost).loc[name, True]] for name in (cartesian, euler)]).pvalue
    differ = "differ significantly" if p_value < P_VALUE else "do not differ significantly"
    return (
        f"Pegs that are not in at the end: {' and '.join(counts)}; the two shares of leaning frames {differ} (Fisher's "
        f"exact test, p = {p_value:.2g})."
    )


def flat(rows: pd.DataFrame) -> str:
    """How many tools come to lie flat on the plate by the paper's force control, and how far those turn that do not."""
    own = rows[rows["task"] == "surface-alignment"]
    if own.empty:
        return f"how tools end on the plate is {ABSENT}"
    parts = []
    for contender, who in ((PAPERS, "with Cartesian compliance"), (PAPERS_EULER, "on the Euler Jacobian")):
        mine = of(own, contender)
        is_flat, leans = mine["time_to_align_s"].notna(), mine["beta_deg"] != 0.0
        parts.append(
            f"{who} {is_flat.sum()} of {len(mine)} tools come to lie flat ({(is_flat & leans).sum()} of {leans.sum()} "
            f"where the hand's frame leans) and turn by up to {np.degrees(mine['held_turn_rad'].max()):.1f}° about the "
            "axis that is to be held"
        )
    return "; ".join(parts)


def tables(run: Run) -> dict:
    """Return one table of all tasks."""
    return {"outcomes": OUTCOMES(compare_tasks(all_rows(run)))}


def compare_tasks(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a task: Cartesian control, the Euler Jacobian by frame of the hand, springs."""
    for task, own in rows.groupby("task", sort=False):
        euler, plain, measure = of(own, PAPERS_EULER), of(own, PAPERS), MEASURES[str(task)]
        leaning = euler[euler["beta_deg"] == euler["beta_deg"].max()]
        columns = plain, euler[euler["beta_deg"] == 0.0], leaning, of(own, SPRINGS)
        yield str(task).replace("-", " "), measure.title, len(plain), *map(measure.of, columns)


def figures(_: Run) -> dict:
    """Return the tasks, and the loop of two arms at a plate."""
    return {"contact-tasks": media.still(STILLS, "contact-tasks"), "plate-loop": media.loop(LOOP, "plate-loop")}
