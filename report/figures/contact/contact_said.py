"""Numbers, answers and one table of the page on tasks in contact; words where a run does not hold them."""

from __future__ import annotations

import numpy as np
import pandas as pd

import tasks
from report.figures.contact import compliance_rows, contact_models, contact_results
from report.figures.kit import absent, html, media
from report.figures.kit.spelling import power
from tasks.contact import STANDARD

CONTROLS = ("hybrid-unconverted/zyx-euler",)
"""Controllers that are there to fail."""

QUANTILE = 0.95


def said(rows: pd.DataFrame) -> dict[str, str]:
    """Of the whole page.

    Args:
        rows: of `contact_results.all_rows`.
    """
    betas = ", ".join(f"{beta:.0f}°" for beta in sorted(set(rows["beta_deg"]))) if len(rows) else absent.WORDS
    return {
        **plate(rows),
        "betas": betas,
        "orders": orders(),
        "timeconst": f"{1e3 * STANDARD.timeconst:g}",
        "friction": f"{STANDARD.friction:g}",
        "penetration": penetration(rows),
        "models_trial": f"{tasks.arm(contact_models.ARM).title}, {named(contact_models.TRIAL)}",
        "worst": worst(rows),
        "stuck": stuck(rows),
    }


def plate(rows: pd.DataFrame) -> dict[str, str]:
    """What the loop shows: the angles [deg] at the end of its two episodes, in this run."""
    about = media.facts()["contact"]
    shown, values = about["plate"], {"plate_arm": tasks.arm(about["arm"]).title}
    trials = tasks.contact_task(shown["task"]).trials(tasks.arm(about["arm"]))
    trial = next(one for one in trials if one.id == shown["trial"])
    values["plate_tilt"] = f"{np.degrees(trial.tilt):.0f}"
    values["plate_force"] = f"{np.linalg.norm(trial.order.exerts[:3]):.0f}"
    values["plate_beta"] = trial.id.rpartition("beta+")[2]
    own = rows[(rows["task"] == shown["task"]) & (rows["arm"] == about["arm"]) & (rows["pose"] == shown["trial"])]
    for word, contender in zip(("plate_cartesian", "plate_euler"), shown["controllers"], strict=True):
        one = own[own["contender"] == contender]
        values[word] = f"{np.degrees(one['alignment_error_rad'].iloc[0]):.1f}" if len(one) else absent.WORDS
    return values


def orders() -> str:
    """What each task is, and what its order lets comply."""
    arm, lines = tasks.arm(media.facts()["contact"]["arm"]), []
    for name in contact_results.MEASURES:
        task = tasks.contact_task(name)
        lines.append(f"{task.title} (complies: {task.trials(arm)[0].order.name})")
    return f"{'. '.join(lines)}."


def working(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of controllers that are not there to fail."""
    return rows[~rows["way"].isin(CONTROLS)]


def penetration(rows: pd.DataFrame) -> str:
    """How deep the hand is in its surroundings at the worst, of those that reach the end."""
    own = working(rows)
    own = own[own["outcome"] == "done"]
    if own.empty:
        return f"How deep they penetrate is {absent.WORDS}."
    deepest = 1e3 * own["penetration_m"].dropna()
    return (
        f"Over the {len(deepest)} episodes that reach the end hand and scene penetrate by {deepest.median():.2f} mm in "
        f"the median, and by {deepest.quantile(QUANTILE):.2f} mm or less in {QUANTILE:.0%}; what is beyond are hands "
        "thrown about by coordinates near their singularity."
    )


def contact(rows: pd.DataFrame) -> html.Markdown:
    """A task a line."""
    lines = []
    for name in contact_results.tasks_of(rows):
        own = working(rows[rows["task"] == name])
        failed = own.loc[own["outcome"] != "done", "outcome"].value_counts()
        lines.append(
            {
                "Task": html.together(name),
                "Episodes": len(own),
                "Reach the end [%]": 100.0 * float((own["outcome"] == "done").mean()),
                "The others": ", ".join(f"{count} {word}" for word, count in failed.items()) or "none",
                "Penetration, median [mm]": 1e3 * float(own["penetration_m"].median()) + 0.0,
                f"in {QUANTILE:.0%} [mm]": 1e3 * float(own["penetration_m"].quantile(QUANTILE)) + 0.0,
                "Largest force, median [N]": float(own["peak_force_n"].median()),
            }
        )
    forms = {"Reach the end [%]": ".1f", "Penetration, median [mm]": ".3f", f"in {QUANTILE:.0%} [mm]": ".2f"}
    return absent.table(
        pd.DataFrame(lines), lambda frame: html.table(frame, {**forms, "Largest force, median [N]": ".0f"})
    )


def worst(rows: pd.DataFrame) -> str:
    """Where the Euler Jacobian is furthest from the Cartesian one, on the plate."""
    own = rows[rows["task"] == "surface-alignment"]
    if own.empty:
        return f"How tools end on the plate is {absent.WORDS}."
    both = (compliance_rows.of(own, name) for name in (compliance_rows.CARTESIAN, compliance_rows.EULER))
    pair = next(both).merge(next(both), on=["arm", "pose"])
    turned = pair.loc[pair["held_turn_rad_y"].idxmax()]
    tilted = pair.loc[pair["alignment_error_rad_y"].idxmax()]
    flat = np.degrees(pair["alignment_error_rad_x"].max())
    return (
        f"On the plate the Cartesian tool lies flat to {power(flat)} degrees in all {len(pair)} episodes. By the Euler "
        f"one it ends {np.degrees(tilted['alignment_error_rad_y']):.0f}° off ({told(tilted)}), and has turned by "
        f"{np.degrees(turned['held_turn_rad_y']):.0f}° about the axis that it was told to hold ({told(turned)})."
    )


def stuck(rows: pd.DataFrame) -> str:
    """How many pegs end stuck, by both Jacobians, where the hand's frame leans and where it does not."""
    own = rows[rows["task"] == "peg-in-hole"]
    if own.empty:
        return f"How pegs end is {absent.WORDS}."
    counts = []
    for contender, who in ((compliance_rows.CARTESIAN, "Cartesian"), (compliance_rows.EULER, "on the Euler Jacobian")):
        mine = compliance_rows.of(own, contender)
        level, leaning = mine[mine["beta_deg"] == 0.0]["jam"], mine[mine["beta_deg"] != 0.0]["jam"]
        counts.append(
            f"{who} {level.sum():.0f} of {level.count()} where the frame is level and {leaning.sum():.0f} of "
            f"{leaning.count()} where it leans"
        )
    return f"Pegs that end stuck: {'; '.join(counts)}."


def told(row: pd.Series) -> str:
    """An episode's arm and pose."""
    return f"{row['arm']}, {named(row['pose'])}"


def named(pose: str) -> str:
    """A pose as the page spells it: tilt 20 about 0, beta+75."""
    return pose.replace("beta+", "β = ").replace("beta-", "β = −") + "°"
