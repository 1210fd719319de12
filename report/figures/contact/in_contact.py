"""The page on tasks in contact: a plate, a peg, a crank and a plane, by controller and frame of the hand.

And what all pages on compliance read of compliance.parquet: rows of a task, of a controller, and of a frame.
"""

import functools
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.stats import fisher_exact

import tasks
from bench.experiments.tables.run import Run, require_rows
from bench.findings.amounts import join_words, part_of
from report.figures.kit import html, media
from report.figures.kit.page import ABSENT, in_run
from report.figures.kit.spelling import spell_powers

CARTESIAN, EULER = "hybrid-base+inverse", "hybrid/zyx-euler+inverse"
PAPERS, PAPERS_EULER = "hybrid-base+transpose", "hybrid/zyx-euler+transpose"
WORDS = ("task", "arm", "contender", "complies", "pose", "outcome", "rest", "form")

P_VALUE = 0.05
"""P-value of Fisher's exact test, both sides: below it two shares of pegs differ significantly."""
SPRINGS = "impedance-geometric"
DEGREES = 180.0 / np.pi
LOOP = (
    "Two arms press a square tool onto a tilted plate. With Cartesian compliance the tool turns "
    "until it lies flat; with the Euler Jacobian it stays level, on one edge."
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
    "surface-alignment": Measure("alignment_error_rad", "angle between tool and plate [deg]", DEGREES),
    "peg-in-hole": Measure("jam", "pegs not inserted [%]", 100.0, 100.0),
    "crank": Measure("crank_angle_rad", "crank turned by [deg]", DEGREES, -np.inf),
    "force-on-plane": Measure("normal_force_error_n", "force error, root mean square [N]"),
}
"""Task -> the number that says how it went, the tasks that free rotations first."""

OUTCOME_HEADS = (
    "Result with Cartesian compliance",
    "Result with the Euler Jacobian at β = 0",
    "Result with the Euler Jacobian at the largest β",
    "Result with an impedance (springs)",
)
OUTCOMES = html.PageTable(
    f"Task | Measured at the end | Number of episodes with Cartesian compliance | {' | '.join(OUTCOME_HEADS)}",
    words=OUTCOME_HEADS,
)


def facts(run: Run) -> dict:
    """Return the loop of two arms at a plate, how episodes end, and one table of all tasks."""
    return {"plate-loop": media.loop(LOOP, "plate-loop"), **(in_run(describe_tasks, run) or {})}


def describe_tasks(run: Run) -> dict:
    """Return how episodes end, in words and in a table."""
    found = [of_task(run, name) for name in MEASURES if len(run.any_rows("compliance", task=name))]
    rows = pd.concat(require_rows(found, "task in contact"), ignore_index=True)
    return {
        "outcomes": OUTCOMES(compare_tasks(rows)),
        **plate(rows),
        "betas": join_words([f"{beta:.0f}°" for beta in sorted(set(rows["beta_deg"]))]),
        "flat": flat(rows),
        "pegs": in_run(count_pegs, rows),
        "pegs_differ": compare_pegs(rows, PAPERS, PAPERS_EULER),
        "other_pegs_differ": compare_pegs(rows, CARTESIAN, EULER),
        "pegs_finding": describe_pegs(rows),
        "finding": describe_cranks(rows),
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


PEGS = html.PageTable(
    "Controller | Pegs not inserted if the frame of the hand is not tilted | "
    "Pegs not inserted if the frame of the hand is tilted"
)
CONTROLS = {
    PAPERS: "Force control, Cartesian compliance",
    PAPERS_EULER: "Force control, Euler Jacobian",
    CARTESIAN: "Commanded accelerations, Cartesian compliance",
    EULER: "Commanded accelerations, Euler Jacobian",
}


def read_pegs(rows: pd.DataFrame, contender: str) -> dict[bool, pd.Series]:
    """Return whether each peg of a controller is not in at the end, by whether the hand's frame is tilted."""
    pegs = of(require_rows(rows[rows["task"] == "peg-in-hole"], "peg"), contender)
    is_out, is_tilted = pegs["jam"] != 0.0, pegs["beta_deg"] != 0.0
    return {False: is_out[~is_tilted], True: is_out[is_tilted]}


def count_pegs(rows: pd.DataFrame) -> Any:
    """Return a table of the pegs that are not in at the end: a row a controller, a column a frame."""
    lines = []
    for contender, name in CONTROLS.items():
        pegs = read_pegs(rows, contender)
        lines.append((name, *(count_out(pegs[is_tilted]) for is_tilted in (False, True))))
    return PEGS(lines)


def count_out(is_out: pd.Series) -> str:
    """Return "24 of 96", "none of 48", "all 48" or "not tested"."""
    return html.UNTESTED if is_out.empty else part_of(int(is_out.sum()), len(is_out))


def describe_pegs(rows: pd.DataFrame) -> str:
    """Say how many pegs are not in with a tilted frame and commanded accelerations, by both Jacobians."""
    if not (rows["task"] == "peg-in-hole").any():
        return f"How pegs end is {ABSENT}"
    cartesian, euler = (count_out(read_pegs(rows, contender)[True]) for contender in (CARTESIAN, EULER))
    return (
        f"With a tilted frame of the hand and commanded accelerations, {euler} pegs stay outside the hole with the "
        f"Euler Jacobian, and {cartesian} pegs with Cartesian compliance"
    )


def compare_pegs(rows: pd.DataFrame, cartesian: str, euler: str) -> str:
    """Say whether the shares of pegs that are not in differ between two Jacobians where the hand's frame is tilted."""
    if not (rows["task"] == "peg-in-hole").any():
        return f"How pegs end is {ABSENT}."
    tilted = [read_pegs(rows, contender)[True] for contender in (cartesian, euler)]
    if any(is_out.empty for is_out in tilted):
        return f"Cartesian compliance or the Euler Jacobian is {ABSENT}."
    p_value = fisher_exact([[int(is_out.sum()), int((~is_out).sum())] for is_out in tilted]).pvalue
    differ = "differ significantly" if p_value < P_VALUE else "do not differ significantly"
    p_text = spell_powers(f"{p_value:.2g}")
    return (
        f"With a tilted frame of the hand, the shares of pegs that are not inserted {differ} between "
        f"Cartesian compliance and the Euler Jacobian (Fisher's exact test, p = {p_text})."
    )


def count_flat(is_flat: pd.Series) -> str:
    """Return "all 48", "34 of 144" or "none of 144"."""
    return part_of(int(is_flat.sum()), len(is_flat))


def flat(rows: pd.DataFrame) -> str:
    """Return how many tools come to lie flat on the plate by the paper's force control."""
    plates = rows[rows["task"] == "surface-alignment"]
    if plates.empty:
        return f"how tools end is {ABSENT}."
    euler, cartesian = (of(plates, name)["time_to_align_s"].notna() for name in (PAPERS_EULER, PAPERS))
    return (
        f"at the end the tool lay flat in {count_flat(euler)} simulations with Euler angles (the "
        f"Euler Jacobian), and in {count_flat(cartesian)} simulations with the axes of the base "
        "frame (Cartesian compliance)."
    )


def describe_cranks(rows: pd.DataFrame) -> str:
    """Say how far hands turn the crank by both Jacobians, at the largest tilt of the hand's frame."""
    cranks, measure = rows[rows["task"] == "crank"], MEASURES["crank"]
    if cranks.empty:
        return f"How far cranks turn is {ABSENT}"
    euler = of(cranks, PAPERS_EULER)
    most = euler["beta_deg"].max()
    cartesian, tilted = measure.of(of(cranks, PAPERS)), measure.of(euler[euler["beta_deg"] == most])
    return (
        f"The hand turns the crank by {cartesian}° with Cartesian compliance, and by {tilted}° "
        f"with the Euler Jacobian at β = {most:.0f}°"
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
