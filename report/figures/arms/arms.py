"""The page on arms: which laws settle on arms as they are, what limits them, and what a wrong model leaves."""

import itertools
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

import tasks
from bench.experiments.tables.run import Run, require_rows
from bench.findings.amounts import join_words
from bench.findings.claims.tables import settled, share
from bench.findings.on_arms import FULL, best, passed
from bench.findings.selection.robots import ARM, decide_for
from bench.law.contenders.registry import baselines_of_arms
from report.figures.arms import arm_rows
from report.figures.kit import families, html, media
from report.figures.kit.page import in_run
from report.figures.kit.spelling import prose

HOMES = (
    "Renders of the four arms side by side, each in its home pose: Kinova Jaco, Franka Emika "
    "Panda, Unimation PUMA 560, Universal Robots UR5e. Axes mark the base and the tool."
)
RANKED = html.PageTable(
    "Law | Turns that settle [%] | Turns that settle and touch no limit [%] | Moves that settle "
    "[%] | Moves that settle and touch no limit [%]"
)
LIMITED = html.PageTable(
    "Arm | Motors | Stiffness Kp [1/s²] | Turns that settle [%] | Turns in which a motor reaches "
    "its rated torque [%] | Turns stopped by a joint's end [%] | Turns that fail for another "
    "reason [%]"
)
SETS = ("uniform", "reach")
MOTORS = {
    **{"nominal": "usual motor inertia", "motors-low": "smallest motor inertia"},
    **{"motors-high": "largest motor inertia"},
    **{"motors-slow": "torque with a first-order lag of 5 ms", "motors-late": "torque with a delay of 5 ms"},
}
ORIGINS = tomllib.loads(Path(__file__).with_name("origins.toml").read_text(encoding="utf-8"))
"""Sentences of the page: where our arms are from. Of another arm, its file says it."""
COLUMNS = tuple((name, measure) for name in SETS for measure in ("settled", "range"))
FEW = 4  # names up to this number are said, more are counted; the table has them


def facts(run: Run) -> dict:
    """Return where the arms are from, which law to take, what limits the laws, and what a wrong model leaves."""
    one = in_run(decide_for, ARM)
    return {
        "arms-at-home": media.still(HOMES, "arms"),
        "sources": "\n".join(map(describe_arm, tasks.arm_names())),
        "lead": in_run(lambda: lead(of_laws(arm_rows.episodes(run), "uniform"))),
        "leading": in_run(
            lambda: leading(of_laws(arm_rows.episodes(run), "uniform"), "settled", "turns").replace("(2.2) ", "")
        ),
        "stopped": in_run(lambda: f"{percent_stopped(of_laws(arm_rows.episodes(run), 'uniform')):.0f}"),
        "advised": families.word(one.law) if one and one.law else "none, for this run does not tell",
        "joint_pd": in_run(lambda: joint_pd(arm_rows.episodes(run))),
        "tab_ranked": in_run(lambda: RANKED(ranked(arm_rows.episodes(run)))),
        "tab_limited": in_run(lambda: LIMITED(limited(arm_rows.every(run)))),
        "model_errors": in_run(lambda: describe_model_errors(run)),
    }


def describe_arm(name: str) -> str:
    """Return an item of a list: where an arm is from, and what it has here."""
    source = ORIGINS.get(name, re.sub(r"(?<![\w.])(?=\.\d)", "0", tasks.arm(name).source))
    return f"- **{arm_rows.name_arm(name)}** (`{name}`): {prose(source)}"


def of_laws(rows: pd.DataFrame, start_set: str) -> pd.DataFrame:
    """Episodes of the laws by the paper's two Jacobians and the standard inverse, from one set."""
    return arm_rows.with_standard(rows[rows["start_set"] == start_set])


def ranked(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a law, best first, then baselines, of `arm_rows.episodes`; percentages are bold if unbeaten."""
    laws = arm_rows.with_standard(rows)
    top = {(name, one): best(laws[laws["start_set"] == name], one, "controller") for name, one in COLUMNS}
    own = pd.concat([laws, rows[rows["regulator"].isin(baselines_of_arms())]])
    own = own[own["start_set"].isin(SETS)]
    own = own.assign(**passed(own), after=own["regulator"].isin(baselines_of_arms()))
    means = own[own["start_set"] == SETS[0]].groupby("controller")[["after", "settled"]].mean()
    for controller in means.sort_values(["after", "settled"], ascending=[True, False], kind="stable").index:
        cells = []
        for name, measure in COLUMNS:
            mine = own.loc[(own["controller"] == controller) & (own["start_set"] == name), measure]
            text = html.UNTESTED
            if len(mine):
                value, low, high = (f"{100 * one:.0f}" for one in share(mine)[2:])
                text = f"{value} ({low} to {high})".replace(" ", "\N{NO-BREAK SPACE}")
            cells.append(f"**{text}**" if controller in top[name, measure] else text)
        yield arm_rows.title(controller).removeprefix("(2.2) "), *cells


def limited(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row for each arm, motors and gains: what settles, what stops the others; of `arm_rows.every`."""
    rows = of_laws(rows, SETS[0])
    rows = compare_settings(rows[rows["variation"].isin(MOTORS)], ["variation", "kp"])
    for arm, motors in itertools.product(rows["arm"].unique(), MOTORS):
        every = rows[(rows["arm"] == arm) & (rows["variation"] == motors)]
        for kp, own in every.groupby("kp"):
            counts = settled(own).sum(), (own["peak_torque_ratio"] > FULL).sum(), count_stopped(own)
            shares = (f"{100 * one / len(own):.0f}" for one in (*counts, len(own) - counts[0] - counts[2]))
            yield arm_rows.name_arm(arm), MOTORS[motors], f"{kp:g}", *shares


def compare_settings(rows: pd.DataFrame, settings: list[str]) -> pd.DataFrame:
    """Return the rows of the starts of an arm that ran under all its settings."""
    ran = rows.groupby(["arm", "start_id"])[settings].transform("nunique").sum(axis=1)
    return rows[ran == ran.groupby(rows["arm"]).transform("max")]


def count_stopped(rows: pd.DataFrame) -> int:
    """Return how many episodes did not settle and had a joint at the end of its range."""
    return int((~settled(rows) & (rows["range_excess_rad"] > 0.0)).sum())


def percent_stopped(rows: pd.DataFrame) -> float:
    """Return in how many of 100 episodes that do not settle a joint was at the end of its range."""
    return 100.0 * count_stopped(rows) / max(1, (~settled(rows)).sum())


def describe_share(rows: pd.DataFrame, controller: str, measure: str) -> str:
    """Share of a controller's episodes that pass, with its interval and n, in words."""
    own = passed(rows[rows["controller"] == controller])[measure]
    found = share(own)
    interval = f"{100 * found.low:.0f} to {100 * found.high:.0f} %"
    return f"{100 * found.value:.0f} % (confidence interval {interval}, n = {found.n})"


def lead(uniform: pd.DataFrame) -> str:
    """State who settles most on arms as they are, what gains do, and what stops the others; uniform: of `of_laws`."""
    is_settled, by_arm = settled(uniform), settled(uniform).groupby(uniform["arm"]).mean()
    is_shipped = uniform["kp"] == uniform["arm"].map(lambda arm: (*tasks.arm(arm).gains, 0.0)[0])
    kinds = uniform["kp"].map("Kp = {:g}/s²".format).mask(is_shipped, "the gains shipped for the arm")
    both = uniform.assign(kind=kinds, settled=is_settled)
    has_three = both.groupby("arm")["kp"].transform("nunique") > 2
    few = join_words(f"the {arm_rows.name_arm(arm)}" for arm in both.loc[~has_three, "arm"].unique())
    both = compare_settings(both[has_three], ["kp"])
    levels = [f"{100 * own['settled'].mean():.0f} % with {kind}" for kind, own in both.groupby("kind")]
    ends = [f"{arm_rows.name_arm(arm)} ({100 * by_arm[arm]:.0f} %)" for arm in (by_arm.idxmin(), by_arm.idxmax())]
    return (
        "In our simulations, motors give at most their rated torque, and joints stop at the ends of their ranges. "
        "These results are from evenly spread starts. "
        f"{leading(uniform, 'settled').replace('(2.2) ', '')} of the episodes settle. We simulated "
        f"all arms{f' except {few}' if few else ''} with three pairs of gains. "
        "On these arms, with all laws counted together, the share of episodes that settle is "
        f"{join_words(levels or [html.UNTESTED])}. A joint was at the end of its range in "
        f"{percent_stopped(uniform):.0f} % of the episodes that do not settle. The share of episodes that settle is "
        f"smallest on the {ends[0]} and largest on the {ends[1]}."
    )


def leading(rows: pd.DataFrame, measure: str, word: str = "episodes") -> str:
    """Which law passes most, or which are not distinguished from it, in words; word: what the rows are called."""
    names = best(rows, measure, "controller")
    share_of_first = describe_share(rows, names[0], measure)
    if len(names) == 1:
        return f"{arm_rows.title(names[0])} is better than every other law. With this law, {share_of_first}"
    words = join_words(map(arm_rows.title, names)) if len(names) <= FEW else f"{len(names)} laws"
    first = arm_rows.title(names[0])
    return (
        f"With {words}, the share of {word} that settle does not differ significantly from the largest share, "
        f"the share with {first}. With {first}, {share_of_first}"
    )


def joint_pd(rows: pd.DataFrame) -> str:
    """Return what joint PD settles from evenly spread starts."""
    return describe_share(rows[rows["start_set"] == "uniform"], "joint-pd@joints", "settled")


def describe_model_errors(run: Run) -> str:
    """State how far apart controllers end on a plant that is not their model, and what the variations leave."""
    believed = [name for name in tasks.variation_names() if tasks.variation(name).believed]
    rows = arm_rows.with_standard(arm_rows.every(run))
    is_compared = rows["variation"].isin(believed) & rows["controller"].isin(arm_rows.COMPARED)
    rows = require_rows(rows[is_compared], "variation")
    key = ["arm", "start_id", "variation"]
    angles = rows.pivot_table("final_angle_rad", key, "controller", observed=True).dropna()
    apart = np.degrees(np.ptp(angles.to_numpy(), axis=1))
    medians = np.degrees(rows.groupby("variation")["final_angle_rad"].median())
    return (
        "For each start, we computed the difference between the largest and the smallest error of the controllers. "
        f"The median difference is {np.median(apart):.1g}°. The median error is largest with the variation "
        f"`{medians.idxmax()}`: {medians.max():.1f}°. The median error is smallest with the "
        f"variation `{medians.idxmin()}`: {medians.min():.2f}°."
    )
