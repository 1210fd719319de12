"""The page on tasks in contact: a plate, a peg, a crank and a plane, by controller and frame of the hand.

And what all pages on compliance read of compliance.parquet: rows of a task, of a controller, and of a frame.
"""

import functools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy.stats import fisher_exact

import tasks
from bench.findings.claims.tables import some
from report.figures.kit import html, media
from report.figures.kit.page import ABSENT, Run, in_run
from report.figures.kit.spelling import spell_powers

CARTESIAN, EULER = "hybrid-base+inverse", "hybrid/zyx-euler+inverse"
PAPERS, PAPERS_EULER = "hybrid-base+transpose", "hybrid/zyx-euler+transpose"
WORDS = ("task", "arm", "contender", "complies", "pose", "outcome", "rest", "form")

P_VALUE = 0.05
"""P-value of Fisher's exact test, both sides: below it two shares of pegs differ significantly."""
SPRINGS = "impedance-geometric"
DEGREES = 180.0 / np.pi
LOOP = (
    "Two arms press a square tool onto a tilted plate. With Cartesian compliance the tool turns until it lies flat; "
    "with the Euler Jacobian it stays level, on one edge."
)


class Measure(NamedTuple):
    """A column of compliance.parquet: its words with the unit, the factor to it, and what a failed episode counts."""

    column: str
    title: str
    factor: float = 1.0
    failed: float = np.inf

    def compute(self, rows: pd.DataFrame) -> float:
        """Return the median of the rows, of a share the mean; infinite where at least half of the episodes failed."""
        values = (rows[self.column] * self.factor).fillna(self.failed)
        return float(values.mean() if "%" in self.title else values.median())

    def of(self, rows: pd.DataFrame) -> str:
        """Return the number in short; a dash if it is infinite."""
        value = self.compute(rows)
        return f"{value:.2g}" if np.isfinite(value) else html.MISSING


MEASURES = {
    "surface-alignment": Measure("alignment_error_rad", "tool to plate [deg]", DEGREES),
    "peg-in-hole": Measure("jam", "not inserted [%]", 100.0, 100.0),
    "crank": Measure("crank_angle_rad", "turned by [deg]", DEGREES, -np.inf),
    "force-on-plane": Measure("normal_force_error_n", "force error, rms [N]"),
}
"""Task -> the number that says how it went, the tasks that free rotations first."""

OUTCOMES = html.Table(
    "Task | Measured at the end | Episodes | Cartesian | Euler, β = 0 | Euler, largest β | Springs",
    words=("Cartesian", "Euler, β = 0", "Euler, largest β", "Springs"),
)


def facts(run: Run) -> dict:
    """Return the loop of two arms at a plate, how episodes end, and one table of all tasks."""
    return {"plate-loop": media.loop(LOOP, "plate-loop"), **(in_run(describe_tasks, run) or {})}


def describe_tasks(run: Run) -> dict:
    """Return how episodes end, in words and in a table."""
    found = [of_task(run, name) for name in MEASURES if len(run.any_rows("compliance", task=name))]
    rows = pd.concat(some(found, "task in contact"), ignore_index=True)
    return {
        "outcomes": OUTCOMES(compare_tasks(rows)),
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
        f"{lost.loc[name].sum()} of {n.loc[name].sum()} simulations {who} ({lost.loc[name, True]} of "
        f"{n.loc[name, True]} with a tilted frame)"
        for name, who in ((cartesian, "with Cartesian compliance"), (euler, "with the Euler Jacobian"))
    ]
    p_value = fisher_exact([[lost.loc[name, True], (n - lost).loc[name, True]] for name in (cartesian, euler)]).pvalue
    differ = "differ significantly" if p_value < P_VALUE else "do not differ significantly"
    return (
        f"The peg was not inserted in {' and in '.join(counts)}. The two shares with tilted frames {differ} "
        f"(Fisher's exact test, p = {spell_powers(f'{p_value:.2g}')})."
    )


def flat(rows: pd.DataFrame) -> str:
    """Return how many tools come to lie flat on the plate by the paper's force control."""
    own = rows[rows["task"] == "surface-alignment"]
    if own.empty:
        return f"how tools end is {ABSENT}."
    euler, plain = (of(own, name)["time_to_align_s"].notna() for name in (PAPERS_EULER, PAPERS))
    return (
        f"at the end it lay flat in {euler.sum()} of {len(euler)} simulations with the Euler Jacobian, and in "
        f"{plain.sum()} of {len(plain)} with Cartesian compliance."
    )


def compare_tasks(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a task: Cartesian control, the Euler Jacobian by frame of the hand, springs."""
    for task, own in rows.groupby("task", sort=False):
        euler, plain, measure = of(own, PAPERS_EULER), of(own, PAPERS), MEASURES[str(task)]
        leaning = euler[euler["beta_deg"] == euler["beta_deg"].max()]
        columns = plain, euler[euler["beta_deg"] == 0.0], leaning, of(own, SPRINGS)
        yield str(task).replace("-", " "), measure.title, len(plain), *map(measure.of, columns)


@functools.cache
def of_task(run: Run, task: str) -> pd.DataFrame:
    """Return rows of one task, with plain words and the goal's angles [deg]."""
    found = run.rows("compliance", task=task)
    found = found.assign(**{word: found[word].astype(str) for word in WORDS})
    angles = ("alpha", "beta", "gamma", "tilt")
    return found.assign(**{f"{name}_deg": np.degrees(found[name]).round(6) + 0.0 for name in angles})


def of(rows: pd.DataFrame, contender: str, complies: str = "") -> pd.DataFrame:
    """Rows of one controller, and of one order if it is named."""
    own = rows[rows["contender"] == contender]
    return own[own["complies"] == complies] if complies else own


def level(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows whose goal has no alpha and no gamma, by beta."""
    return rows[(rows["alpha_deg"] == 0.0) & (rows["gamma_deg"] == 0.0)].sort_values("beta_deg", kind="stable")
