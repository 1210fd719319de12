"""C25, C47: complex compliant motions by both Jacobians, and force control by the common one (Murphy 1988, 3.3)."""

from __future__ import annotations

import numpy as np

from bench.base.errors import NoEvidence
from bench.base.on_first_use import pd
from bench.experiments.tables.run import Run, require_rows
from bench.findings.amounts import capitalize, count, count_of
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.side_by_side import BASE, by_papers_form, paired
from bench.findings.claims.tables import evidence, percent
from bench.findings.claims.verdict import Evidence, Word, claim, word_of
from tasks.contact_rest import HORIZON_S, WINDOW_S

# |beta| of the hand's frame from which on the two must differ: its x then leans to z as much as it lies level.
TURNED_DEG = 45.0
# Factor between two numbers that are not the same performance.
PARTS = 2.0
MORE_IS_BETTER = ("insertion_depth_m",)
# Columns that have a number only after a touch.
TOUCHED = ("force_error_rms_n", "moment_error_rms_nm")
# What rounding may make of an angle that a frame is named after.
ZERO_RAD = 1e-9
SLACK_DEG = 1e-6
# Tasks that press on a plane with so many newtons, and that lay a tool flush by complying about two axes.
PRESSED = "force-on-plane"
ALIGNED = "surface-alignment"
FORCE_N = 15.0
# Share of that force: without control it would be 1.
MISSED = 0.5
# Half a degree of what is held.
HELD_RAD = 0.01


FLOORS = {"rad": 1e-3, "N": 0.1, "N m": 0.01, "m": 1e-4}
"""Floors by unit; a number below is taken for it, so that nothing is compared with almost nothing. About what the
contact of a simulated hand leaves at rest."""

PERFORMANCE = {
    "alignment_error_rad": "rad",
    "force_error_rms_n": "N",
    "moment_error_rms_nm": "N m",
    "peak_force_n": "N",
    "peak_moment_nm": "N m",
    "insertion_depth_m": "m",
}
"""Columns that say how well a task went, and their units."""

LIMITS_S = {"end": HORIZON_S, "window": WINDOW_S}
"""When a task that has an end is stopped, and the first time in contact that rms errors are of."""


@claim("C25")
@by_papers_form
def c25(run: Run, forms: tuple[str, ...]) -> tuple[Word, Evidence]:
    """Pairs of episodes in contact that differ in the Jacobian alone, by task."""
    what = f"pose of a task by hybrid/{COORDINATES} and {BASE}, +{' or +'.join(forms)}"
    rows = require_rows(paired(run, COORDINATES, forms, ("beta", "outcome", *PERFORMANCE)), what)
    touching = rows[list(TOUCHED)].notna().groupby(rows["task"]).transform("any").any(axis=1)
    rows = require_rows(_compared(rows[touching].reset_index(drop=True)), "pose of a task with contact")
    complex_ones = require_rows(rows[rows["turns"] >= 2], "pose of a task with contact where two turns comply")
    depends = [_depends(task, own, forms) for task, own in complex_ones.groupby("task")]
    turned = complex_ones[complex_ones["is_turned"]]
    straight = complex_ones[complex_ones["beta"].abs() <= ZERO_RAD]
    word = word_of(all(depends), turned["parts"].any())
    parted = complex_ones[complex_ones["parts"]]
    by_frame = complex_ones.groupby(["task", "arm", "pose"])["parts"]
    agree = by_frame.nunique()[by_frame.size() == len(forms)] == 1
    agreed = ""
    if len(forms) > 1:
        same = count_of(int(agree.sum()), len(agree), "combinations of task, arm and frame of the hand")
        agreed = f" In {same}, the two runs differ either with every variant of force control or with none."
    simple = rows[rows["turns"] < 2]
    listed = " ".join(_told(task, own) for task, own in complex_ones.groupby("task"))
    return word, evidence(
        f"""The performance depends on the Jacobian in {count_of(sum(depends), len(depends), "tasks")} in which two
        rotations comply. A pair is two runs of a task that differ only in the Jacobian: one run with the Euler
        Jacobian, and one with the geometric Jacobian. The two runs differ if their outcomes differ, or if a
        measured result differs by a factor of {PARTS:g} or more. We compared {len(complex_ones)} pairs on
        {complex_ones["arm"].nunique()} arms. The angle beta is that of the frame of the hand. {listed} The run with
        the Euler Jacobian is the worse in {count_of(int(parted["euler_is_worse"].sum()), len(parted), "pairs")}
        that differ.{agreed} In tasks in which fewer than two rotations comply,
        {count_of(int(simple["parts"].sum()), len(simple), "pairs")} differ.""",
        len(rows),
        measured=f"""A pair is one run with each Jacobian (Euler and geometric). If the frame of the hand has |beta|
        >= {TURNED_DEG:g}°, the two runs perform differently in
        {count_of(int(turned["parts"].sum()), len(turned), "pairs")}. With beta = 0, they perform differently in
        {count_of(int(straight["parts"].sum()), len(straight), "pairs")}.""",
    )


def _depends(task: str, rows: pd.DataFrame, forms: tuple[str, ...]) -> bool:
    """Whether on every arm and in every form that it has run some pair with a turned frame parts."""
    for form in forms:
        require_rows(rows[rows["form"] == form], f"pose of {task}, +{form}")
    found = []
    for (arm, form), own in rows.groupby(["arm", "form"]):
        turned, straight = own[own["is_turned"]], own[own["beta"].abs() <= ZERO_RAD]
        if turned.empty or straight.empty:
            raise NoEvidence(
                f"{task} on {arm}, {form}: no frames both at beta = 0 and from "
                f"{TURNED_DEG:g} degrees"
            )
        found.append(turned["parts"].any())
    return all(found)


def _compared(rows: pd.DataFrame) -> pd.DataFrame:
    """Add to the pairs: turns, how many comply; is_turned; factor, NaN if both fail alike; parts; euler_is_worse."""
    worse_by = np.stack([_worse_by(rows, column) for column in PERFORMANCE], axis=1)
    most = worse_by[np.arange(len(rows)), np.abs(worse_by).argmax(axis=1)]
    ends, base_ends = rows["outcome"].astype(str), rows["outcome_base"].astype(str)
    alike = ends == base_ends
    most = np.select([~alike & (ends == "done"), ~alike, ends != "done"], [-np.inf, np.inf, np.nan], most)
    factor = np.exp(np.abs(most))
    return rows.assign(
        turns=[len(set(word.partition("about ")[2]) & set("xyz")) for word in rows["complies"]],
        is_turned=np.degrees(rows["beta"].abs()) >= TURNED_DEG - SLACK_DEG,
        factor=factor,
        parts=factor >= PARTS,
        euler_is_worse=most > 0,
    )


def _worse_by(rows: pd.DataFrame, column: str) -> np.ndarray:
    """Logarithm of the factor by which Euler is worse in one number; infinite if one of the two has none."""
    floor = FLOORS[PERFORMANCE[column]]
    own, base = (np.log(rows[name].clip(lower=floor)) for name in (column, f"{column}_base"))
    by = base - own if column in MORE_IS_BETTER else own - base
    return np.select([own.isna() & base.isna(), own.isna(), base.isna()], [0.0, np.inf, -np.inf], by)


def _told(task: str, rows: pd.DataFrame) -> str:
    """Describe how the pairs of a task with turned and with straight frames part."""
    turned, straight = rows[rows["is_turned"]], rows[rows["beta"].abs() <= ZERO_RAD]
    return (
        f"In the task {task} with |beta| >= {TURNED_DEG:g} degrees, the two runs differ in {_parted(turned)} "
        f"In the task {task} with beta = 0, the two runs differ in {_parted(straight)}"
    )


def _parted(rows: pd.DataFrame) -> str:
    """How many part, how many of them by their outcomes, and the greatest factor of the others."""
    by_outcome = np.isinf(rows["factor"])
    pairs = count_of(int(rows["parts"].sum()), len(rows), "pairs")
    ends, among = "", "The"
    if by_outcome.any():
        ends = f", and their outcomes differ in {count(int(by_outcome.sum()), 'pair')}"
        among = "In the other pairs, the"
    most = rows["factor"][~by_outcome].max()
    return f"{pairs}{ends}. {among} greatest factor between the measured results of the two runs is {most:.3g}."


@claim("C47")
@by_papers_form
def c47(run: Run, forms: tuple[str, ...]) -> tuple[Word, Evidence]:
    """Errors of force, of moment and of rotation of the controller on the geometric Jacobian."""
    rows = run.table("compliance", controller=BASE)
    rows = rows[rows["form"].isin(forms) & rows["task"].isin((PRESSED, ALIGNED))]
    pressed, aligned = (
        require_rows(rows[rows["task"] == task], f"pose of {task} by {BASE}, +{' or +'.join(forms)}")
        for task in (PRESSED, ALIGNED)
    )
    force = float(pressed["normal_force_error_n"].max()) / FORCE_N
    moment, turn = (float(rows[name].max()) for name in ("alignment_error_rad", "held_turn_rad"))
    done = int((rows["outcome"] == "done").sum())
    yields = done == len(rows) and force <= MISSED and moment <= FLOORS["rad"]
    return word_of(yields and turn <= HELD_RAD, yields), evidence(
        f"""{capitalize(count_of(done, len(rows), "runs"))} of the tasks {pressed["task"].iloc[0]} and
        {aligned["task"].iloc[0]} have the outcome 'done'. In the task {pressed["task"].iloc[0]}, the root mean
        square error of the force normal to the plane is at most {percent(force)} % of the commanded
        {FORCE_N:g} N. In the task {aligned["task"].iloc[0]}, the tool complies about two axes. At the end,
        the angle between the tool and the plane is at most {moment:.1e} rad. In both tasks, a rotation that the
        controller must keep constant has changed by at most {turn:.2g} rad at the end.""",
        len(rows),
        measured=f"""The root mean square error of the force is at most {percent(force)} % of the commanded
        {FORCE_N:g} N. A rotation that the controller should keep constant changes by up to {turn:.2g} rad.""",
    )
