"""The page on arms: which laws settle on arms as they are, what limits them, and what a wrong model leaves."""

import numpy as np
import pandas as pd

import tasks
from bench.findings.claims.tables import some
from bench.findings.selection.robots import ARM, decide_for
from report.figures.arms import arm_ranking, arm_rows
from report.figures.kit import families, media
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import prose

HOMES = (
    "Renders of the four arms side by side, each in its home pose: Kinova Jaco, Franka Emika Panda, Unimation PUMA "
    "560, Universal Robots UR5e. Axes mark the base and the tool."
)


def facts(run: Run) -> dict:
    """Return where the arms are from, which law to take, what limits the laws, and what a wrong model leaves."""
    one = in_run(decide_for, ARM, run.folder)
    return {
        "arms-at-home": media.still(HOMES, "arms"),
        "sources": "\n".join(f"- `{name}`: {prose(tasks.arm(name).source)}" for name in tasks.arm_names()),
        "lead": in_run(lambda: arm_ranking.lead(arm_ranking.of_laws(arm_rows.episodes(run), "uniform"))),
        "advised": families.word(one.law) if one and one.law else "none, for this run does not tell",
        "joint_pd": in_run(lambda: joint_pd(arm_rows.episodes(run))),
        "tab_ranked": in_run(lambda: arm_ranking.RANKED(arm_ranking.ranked(arm_rows.episodes(run)))),
        "tab_limited": in_run(lambda: arm_ranking.LIMITED(arm_ranking.limited(arm_rows.every(run)))),
        "model_errors": in_run(lambda: describe_model_errors(run)),
    }


def joint_pd(rows: pd.DataFrame) -> str:
    """Return what joint PD settles from evenly spread starts."""
    return arm_ranking.describe_share(rows[rows["start_set"] == "uniform"], "joint-pd@joints", "settled")


def describe_model_errors(run: Run) -> str:
    """State how far apart controllers end on a plant that is not their model, and what the variations leave."""
    believed = [name for name in tasks.variation_names() if tasks.variation(name).believed]
    rows = arm_rows.with_standard(arm_rows.every(run))
    rows = some(rows[rows["variation"].isin(believed) & rows["controller"].isin(arm_rows.COMPARED)], "variation")
    key = ["arm", "start_id", "variation"]
    angles = rows.pivot_table("final_angle_rad", key, "controller", observed=True).dropna()
    apart = np.degrees(np.ptp(angles.to_numpy(), axis=1))
    medians = np.degrees(rows.groupby("variation")["final_angle_rad"].median())
    return (
        f"From the same start the controllers end {np.median(apart):.1g}° apart in the median; the worst variation, "
        f"{medians.idxmax()}, leaves {medians.max():.1f}°, the mildest, {medians.idxmin()}, {medians.min():.2f}°."
    )
