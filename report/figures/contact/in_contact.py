"""The page on tasks in contact."""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd
from scipy.stats import fisher_exact

import tasks
from report.figures.arms import arm_looks
from report.figures.contact import contact_models, limits
from report.figures.contact.by_frame import MEASURES, Measure, by_frame
from report.figures.contact.ends import ends
from report.figures.contact.rows import CARTESIAN, EULER, PAPERS, PAPERS_EULER, of, of_task, title, verdicts, ways
from report.figures.kit import html, media
from report.figures.kit.page import ABSENT, Run, given
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from tasks.contact_model import STANDARD

CONTROLS = ("hybrid-unconverted/zyx-euler", "hybrid-unconverted/zyx-euler+transpose")
"""Controllers that are there to fail."""

MARKS = {"projected": "(S J)⁺", "transpose": "Jᵀ"}
"""Form -> its mark in a table; J^-1, the usual one, has none."""

QUANTILE = 0.95
P_VALUE = 0.05
"""Of Fisher's exact test, both sides: below it two shares of pegs differ significantly."""


@functools.cache
def all_rows(run: Run) -> pd.DataFrame:
    """Rows of every task in contact; maybe none."""
    return pd.concat([of_task(run, name) for name in MEASURES], ignore_index=True)


def facts(run: Run) -> dict:
    """How episodes end, and what they are."""
    rows = all_rows(run)
    return {
        **plate(rows),
        "orders": orders(),
        "fewer": given(rows, fewer),
        "stiffness": f"{STANDARD.stiffness:,.0f}",
        "damping": f"{STANDARD.damping:,.0f}",
        **ends(rows),
        **limits.facts(),
        "friction": f"{STANDARD.friction:g}",
        "models_trial": f"{tasks.arm(contact_models.ARM).title}, {named(contact_models.TRIAL)}",
        "betas": given(rows, lambda _: ", ".join(f"{beta:.0f}°" for beta in sorted(set(rows["beta_deg"])))),
        "penetration": penetration(rows),
        "worst": worst(rows, PAPERS, PAPERS_EULER),
        "stuck": stuck(rows, PAPERS, PAPERS_EULER),
        "other_worst": worst(rows, CARTESIAN, EULER),
        "other_stuck": stuck(rows, CARTESIAN, EULER),
        "flat": flat(rows),
        "fits": limits.said_of_fits(limits.part("fits")),
    }


def plate(rows: pd.DataFrame) -> dict[str, str]:
    """What the loop shows: the angles [deg] at the end of its two episodes, in this run, and whether that is rest."""
    about = media.facts()["contact"]
    shown, values = about["plate"], {"plate_arm": tasks.arm(about["arm"]).title}
    trials = tasks.contact_task(shown["task"]).trials(tasks.arm(about["arm"]))
    trial = next(one for one in trials if one.id == shown["trial"])
    values["plate_tilt"] = f"{np.degrees(trial.tilt):.0f}"
    values["plate_force"] = f"{np.linalg.norm(trial.specification.desired_wrench[:3]):.0f}"
    values["plate_beta"] = trial.id.rpartition("beta+")[2]
    own = rows[(rows["task"] == shown["task"]) & (rows["arm"] == about["arm"]) & (rows["pose"] == shown["trial"])]
    for word, contender in zip(("plate_cartesian", "plate_euler"), shown["controllers"], strict=True):
        one = own[own["contender"] == contender]
        values[word] = f"{np.degrees(one['alignment_error_rad'].iloc[0]):.1f}" if len(one) else ABSENT
        values[f"{word}_rest"] = word_of_rest(one.iloc[0]) if len(one) else ABSENT
    return values


def orders() -> str:
    """What each task is, and what its order lets comply."""
    arm, lines = tasks.arm(media.facts()["contact"]["arm"]), []
    for name in MEASURES:
        task = tasks.contact_task(name)
        lines.append(f"{task.title} (complies: {task.trials(arm)[0].specification.name})")
    return f"{'. '.join(lines)}."


def fewer(rows: pd.DataFrame) -> str:
    """Which arms run some of the controllers only: medians over arms are then of other arms from line to line."""
    run = rows.groupby("arm")["contender"].nunique()
    parts = [f"the {arm_looks.title(arm)} {count} of {run.max()}" for arm, count in run[run < run.max()].items()]
    if not parts:
        return "Every arm runs every controller."
    return f"Not every arm runs every controller ({'; '.join(parts)}): rows with more episodes cover more arms."


def penetration(rows: pd.DataFrame) -> str:
    """How deep the hand is in its surroundings at the worst, of those that reach the end."""
    own = rows[(rows["outcome"] == "done") & ~rows["way"].isin(CONTROLS)]
    if own.empty:
        return f"How deep they penetrate is {ABSENT}."
    deepest = 1e3 * own["penetration_m"].dropna()
    return (
        f"Over the {len(deepest)} episodes that reach the end hand and scene penetrate by {deepest.median():.2f} mm in "
        f"the median, by {deepest.quantile(QUANTILE):.2f} mm at the {QUANTILE:.0%} quantile and by {deepest.max():.2f} "
        "mm at most."
    )


def worst(rows: pd.DataFrame, cartesian: str, euler: str) -> str:
    """Say where the Euler Jacobian is furthest from the Cartesian one, on the plate."""
    own = rows[(rows["task"] == "surface-alignment") & (rows["outcome"] == "done")]
    pair = of(own, cartesian).merge(of(own, euler), on=["arm", "pose"])
    if pair.empty:
        return f"How tools end on the plate is {ABSENT}."
    turned = pair.loc[pair["held_turn_rad_y"].idxmax()]
    tilted = pair.loc[pair["alignment_error_rad_y"].idxmax()]
    flat = np.degrees(pair["alignment_error_rad_x"].max())
    return (
        f"On the plate the Cartesian tool lies flat to {power(flat)} degrees in all {len(pair)} episodes that both "
        f"end. By the Euler one it ends up to {np.degrees(tilted['alignment_error_rad_y']):.0f}° off "
        f"({of_pose(tilted)}; {word_of_rest(tilted, '_y')}), and has turned by up to "
        f"{np.degrees(turned['held_turn_rad_y']):.0f}° about the axis that it had to hold ({of_pose(turned)}; "
        f"{word_of_rest(turned, '_y')})."
    )


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


def word_of_rest(row: pd.Series, side: str = "") -> str:
    """At rest, or creeping and how fast; of one side of a pair, `_x` or `_y`."""
    if row[f"rest{side}"] == "at-rest":
        return "at rest"
    rate, speed = row[f"remaining_rate_rad_per_s{side}"], 1e3 * row[f"remaining_speed_m_per_s{side}"]
    return f"creeping at {power(np.degrees(rate))} °/s and {power(speed)} mm/s"


def of_pose(row: pd.Series) -> str:
    """An episode's arm and pose."""
    return f"{row['arm']}, {named(row['pose'])}"


def named(pose: str) -> str:
    """A pose as the page spells it: tilt 20 about 0, beta+75."""
    return pose.replace("beta+", "β = ").replace("beta-", "β = −") + "°"


def tables(run: Run) -> dict:
    """Other models of contact; verdicts; a table a task."""
    rows = all_rows(run)
    return {
        "tab_models": contact_models.MODELS(contact_models.models()),
        "verdicts": verdicts(run, "C25"),
        **limits.tables(),
        **{f"tab_{name}": given(rows[rows["task"] == name], of_controllers) for name in MEASURES},
    }


def of_controllers(own: pd.DataFrame) -> html.Markdown | None:
    """A controller a line: how many episodes of one task reach the end, and its two middles at every beta."""
    measures = MEASURES[str(own["task"].iloc[0])]
    betas = sorted(set(own["beta_deg"]))
    shown = betas if len(betas) <= 3 else [betas[0], betas[len(betas) // 2], betas[-1]]
    ends_at_rest = (own["rest"].astype(str) != "").any()
    lines = []
    for contender in in_order(own):
        mine = own[own["contender"] == contender]
        done = mine[mine["outcome"] == "done"]
        counts = [f"{len(done)}/{len(mine)}"]
        counts += [f"{(done['rest'] == 'at-rest').sum()}/{len(done)}"] if ends_at_rest else []
        middles = [measure.over_beta(mine) for measure in measures]
        values = (middle.get(beta, np.nan) for middle in middles for beta in shown)
        lines.append((controller(contender), *map(html.together, counts), *values))
    forms = {_head(measure, b): measure.form for measure in measures for b in shown}
    counted = ("Reach the end", "At rest") if ends_at_rest else ("Reach the end",)
    return Table({"Controller": "", **dict.fromkeys(counted, ""), **forms})(lines)


def _head(measure: Measure, beta: float) -> str:
    return f"{measure.short} [{measure.unit}], {beta:.0f}°"


def controller(contender: str) -> str:
    """A controller in a cell, its coordinates and its form kept whole."""
    way, _, form = contender.partition("+")
    name, comma, coordinates = title(way).rpartition(", ")
    whole = f"{name}, {html.together(coordinates)}" if "/" in way else f"{name}{comma}{coordinates}"
    return f"{whole}, {html.together(MARKS[form])}" if form in MARKS else whole


def in_order(rows: pd.DataFrame) -> list[str]:
    """The controllers of the rows: hybrid ones first, each with its forms side by side."""
    ranks = {way.partition("+")[0]: place for place, way in enumerate(ways(rows))}
    return sorted(
        set(rows["contender"]), key=lambda name: (name.startswith("impedance"), ranks[name.partition("+")[0]], name)
    )


LOOP = (
    "Two arms press a square tool onto a tilted plate. With Cartesian compliance the tool turns until it lies flat; "
    "with the Euler Jacobian it stays level, on one edge."
)


def figures(run: Run) -> dict:
    """The loop of two arms at a plate; tasks by frame of the hand."""
    found = {"plate-loop": media.loop(LOOP, "plate-loop"), "in-contact": given(all_rows(run), by_frame)}
    return {**found, **limits.figures()}
