"""The page on tasks in contact."""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd
from scipy.stats import fisher_exact

import tasks
from bench.base.files import read_json
from bench.engines.metrics.contact.scene import IN
from bench.studies.contact.__main__ import STORED
from report.figures.contact.outcomes import MEASURES, table_of_tasks
from report.figures.contact.rows import CARTESIAN, EULER, PAPERS, PAPERS_EULER, of, of_task, verdicts
from report.figures.kit import media
from report.figures.kit.page import ABSENT, NotInRun, Run, in_run
from report.figures.kit.spelling import power
from tasks.contact_model import STANDARD
from tasks.contact_rest import HORIZON_S, REST

P_VALUE = 0.05
"""P-value of Fisher's exact test, both sides: below it two shares of pegs differ significantly."""
PRESSING = ("surface-alignment", "peg-in-hole", "force-on-plane")
"""Tasks in which a force is ordered."""


@functools.cache
def all_rows(run: Run) -> pd.DataFrame:
    """Return the rows of every task in contact that the run has."""
    found = [of_task(run, name) for name in MEASURES if len(run.any_rows("compliance", task=name))]
    if not found:
        raise NotInRun("no task in contact")
    return pd.concat(found, ignore_index=True)


@functools.cache
def study(part: str) -> pd.DataFrame:
    """Return a part of the committed study of contact."""
    return pd.DataFrame(read_json(STORED)[part])


def facts(run: Run) -> dict:
    """Return how episodes end, and what they are."""
    return {
        **describe_tasks(),
        **limits(),
        **(in_run(lambda: of_run(all_rows(run))) or {}),
        "fits": said_of_fits(study("fits")),
    }


def describe_tasks() -> dict[str, str]:
    """Return what each task is, what its order lets comply, when it ends, and the model of contact."""
    arm = tasks.arm(media.facts()["contact"]["arm"])
    parts = [
        f"{task.title} (complies: {task.trials(arm)[0].specification.name})"
        for task in map(tasks.contact_task, MEASURES)
    ]
    return {
        "orders": f"{'. '.join(parts)}.",
        "rest_rule": f"{1e3 * REST.speed:g} mm/s and {REST.rate:g} rad/s for {REST.hold_s:g} s",
        "rest_horizon": f"{HORIZON_S:g}",
        "stiffness": f"{STANDARD.stiffness:,.0f}",
        "damping": f"{STANDARD.damping:,.0f}",
        "friction": f"{STANDARD.friction:g}",
    }


def of_run(rows: pd.DataFrame) -> dict[str, str]:
    """Return what the run says."""
    return {
        **plate(rows),
        "betas": ", ".join(f"{beta:.0f}°" for beta in sorted(set(rows["beta_deg"]))),
        "rest": rested(rows),
        "overshoot": overshot(rows),
        "flat": flat(rows),
        "stuck": stuck(rows, PAPERS, PAPERS_EULER),
        "other_stuck": stuck(rows, CARTESIAN, EULER),
    }


def plate(rows: pd.DataFrame) -> dict[str, str]:
    """Return what the loop shows: the angles [deg] at the end of its two episodes, and whether that is rest."""
    about = media.facts()["contact"]
    shown, values = about["plate"], {"plate_arm": tasks.arm(about["arm"]).title}
    trials = tasks.contact_task(shown["task"]).trials(tasks.arm(about["arm"]))
    trial = next(one for one in trials if one.id == shown["trial"])
    values["plate_tilt"] = f"{np.degrees(trial.tilt):.0f}"
    values["plate_force"] = f"{np.linalg.norm(trial.specification.desired_wrench[:3]):.0f}"
    values["plate_beta"] = trial.id.rpartition("beta+")[2]
    own = rows[(rows["task"] == shown["task"]) & (rows["arm"] == about["arm"]) & (rows["pose"] == shown["trial"])]
    for word, contender in zip(("plate_cartesian", "plate_euler"), shown["controllers"], strict=True):
        for _, one in own[own["contender"] == contender].iterrows():
            values |= {word: f"{np.degrees(one['alignment_error_rad']):.1f}", f"{word}_rest": word_of_rest(one)}
    return values


def word_of_rest(row: pd.Series) -> str:
    """Return at rest, or creeping and how fast."""
    if row["rest"] == "at-rest":
        return "at rest"
    rate, speed = np.degrees(row["remaining_rate_rad_per_s"]), 1e3 * row["remaining_speed_m_per_s"]
    return f"creeping at {power(rate)} °/s and {power(speed)} mm/s"


def rested(rows: pd.DataFrame) -> str:
    """State how many are at rest by the paper's force control, and how fast the others creep."""
    own = rows[rows["contender"].isin((PAPERS, PAPERS_EULER)) & (rows["rest"] != "")]
    late = own[own["rest"] == "creeping"]
    words = f"{len(own) - len(late)} of {len(own)} are at rest."
    if late.empty:
        return words
    speed, rate = 1e3 * late["remaining_speed_m_per_s"], np.degrees(late["remaining_rate_rad_per_s"])
    return f"{words} The others creep, at most at {power(speed.max())} mm/s and {power(rate.max())} °/s."


def overshot(rows: pd.DataFrame) -> str:
    """State the largest force of each pressing task, by the paper's force control and by accelerations."""
    own = rows[rows["task"].isin(PRESSING) & (rows["outcome"] == "done")]
    peaks = own.groupby(["task", "contender"])["peak_force_n"].median().unstack()
    over = of(own, PAPERS).groupby("task")["force_overshoot"].median()
    parts = [
        f"{task.replace('-', ' ')} {peaks.loc[task, PAPERS]:.0f} N ({1.0 + over[task]:.1f} times the order along it; "
        f"by accelerations {peaks.loc[task, CARTESIAN]:.0f} N)"
        for task in PRESSING
        if task in over.index and CARTESIAN in peaks
    ]
    if not parts:
        return f"How hard they strike is {ABSENT}."
    return f"No controller limits the impact. The largest force is, in the median, {'; '.join(parts)}."


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


def limits() -> dict[str, str]:
    """Return from the study what springs leave, and where a press becomes unstable."""
    springs, boundary = study("springs"), study("boundary")
    steep = springs[springs["tilt_deg"] > 15.0].groupby("stiffness")["left_deg"].max().sort_index(ascending=False)
    is_ours = boundary["controller"] == PAPERS
    ours, others = boundary[is_ours & (boundary["kf"] == 0.5)], boundary[~is_ours]
    return {
        "springs_left": ", ".join(f"{left:.2g}° by {k:g} N m/rad" for k, left in steep.items()),
        "springs_soft": f"{steep.index[-1]:g}",
        "boundary_papers": f"{int(ours['measured'].isna().sum())} of {len(ours)}",
        "boundary_off": f"{100.0 * (others['measured'] / others['theory'] - 1.0).abs().max():.0f}",
        "boundary_longest": f"{ours['delay_ms'].max():g}",
    }


def said_of_fits(fits: pd.DataFrame) -> str:
    """How many pegs go in at each clearance, the widest first, and whether closer fits take fewer."""
    counts = (fits["depth_m"] >= IN).groupby(fits["clearance"]).agg(["sum", "size"]).sort_index(ascending=False)
    told = ", ".join(f"{one['sum']} of {one['size']} at {100 * share:g} %" for share, one in counts.iterrows())
    falls = counts["sum"].is_monotonic_decreasing and counts["sum"].nunique() > 1
    return f"{'fewer' if falls else 'not fewer'} pegs go in the closer they fit: {told} of play"


def tables(run: Run) -> dict:
    """Return the verdict, and one table of all tasks."""
    return {"verdicts": verdicts(run, "C25"), "outcomes": table_of_tasks(all_rows(run))}


LOOP = (
    "Two arms press a square tool onto a tilted plate. With Cartesian compliance the tool turns until it lies flat; "
    "with the Euler Jacobian it stays level, on one edge."
)


def figures(_: Run) -> dict:
    """Return the loop of two arms at a plate."""
    return {"plate-loop": media.loop(LOOP, "plate-loop")}
