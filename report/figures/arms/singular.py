"""What each rule for a singular operational-space inertia does beside the singularities of arms."""

from collections.abc import Iterator

import pandas as pd

from bench.experiments.suites import IDEAL_MOTORS, LISTS, NOMINAL
from bench.experiments.tables.run import Run, require_rows
from bench.findings.amounts import join_words
from bench.findings.claims.tables import settled
from bench.law.contenders.registry import contenders
from report.figures.arms import arm_rows
from report.figures.kit import html

RULES = html.PageTable(
    "Rule for Λ | Arms | Episodes that settle with unlimited torque [%]:.0f | Largest unlimited torque, "
    "divided by the rated torque | Episodes that settle with limited torque [%]:.0f | Largest error of the "
    "tool's position with limited torque [mm]:.0f"
)
START_SET, INVERSE = "wrist", "dynamically-consistent"
REDUNDANT = {False: "arms with six joints", True: "Panda"}


def facts(run: Run) -> dict:
    """Return what the rules do from beside a singularity, in words and in a table."""
    rows = arm_rows.every(run)
    own = rows[rows["way"].isin(LISTS["OPERATIONAL"]) & (rows["start_set"] == START_SET)]
    rows = require_rows(own, "operational-space torque beside a singularity")
    rows = rows.assign(settled=settled(rows), is_redundant=rows["arm"] == "panda")
    return {"said": describe_rules(rows), "torques": compare_torques(rows), "rules": RULES(compare_rules(rows))}


def compare_torques(rows: pd.DataFrame) -> str:
    """Compare the largest torque of the plain inverse with the largest of the other rules, over the rated one."""
    torques = rows[rows["variation"] == IDEAL_MOTORS].groupby("inverse")["peak_torque_ratio"].max()
    others = torques[torques.index != INVERSE].max()
    return (
        f"the largest torque with the plain inverse is {html.number(torques[INVERSE])} times the "
        f"rated torque, and with the other rules it is {html.number(others)} times the rated "
        "torque"
    )


def describe_rules(rows: pd.DataFrame) -> str:
    """Say what the rules do on arms of six joints, with ideal motors and as they are, and on the Panda."""
    six, panda = rows[~rows["is_redundant"]], rows[rows["is_redundant"]]
    ideal, real = (six[six["variation"] == name] for name in (IDEAL_MOTORS, NOMINAL))
    shares, torques = (ideal.groupby("inverse")[column] for column in ("settled", "peak_torque_ratio"))
    settled, torque, cut = 100.0 * shares.mean(), torques.max(), 100.0 * real.groupby("inverse")["settled"].mean()
    others, drift = settled.index != INVERSE, 1000.0 * real.groupby("inverse")["position_error_m"].max().sort_values()
    drifts = join_words(f"{value:.0f} mm ({name_rule(word)})" for word, value in drift.items())
    return (
        f"We simulated each rule from {rows.groupby('arm')['start_id'].nunique().max()} starts close to "
        f"singularities of the wrist, on each arm. If the arms with six joints have unlimited torques, "
        f"{settled[INVERSE]:.0f} % of the episodes with the plain inverse settle, and the largest torque is "
        f"{html.number(torque[INVERSE])} times the rated torque. With the other rules, "
        f"{settled[others].min():.0f} to {settled[others].max():.0f} % of the episodes settle, and the largest "
        f"torque is {html.number(torque[others].max())} times the rated torque. If these arms have limited torques, "
        f"{cut[INVERSE]:.0f} % of the episodes with the plain inverse settle, and {cut[others].min():.0f} to "
        f"{cut[others].max():.0f} % with the other rules. Before these episodes settle, the tool moves away from the "
        f"position that it should keep. The largest distances from this position are {drifts}. With "
        f"every rule, {100 * panda['settled'].mean():.0f} % of the episodes on the Panda settle."
    )


def name_rule(word: str) -> str:
    """Return what the page calls a rule."""
    if word == INVERSE:
        return "plain inverse"
    return contenders("inverses")[word].title.removeprefix("Operational space, ")


def compare_rules(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a rule and number of joints."""
    for word, by_rule in rows.groupby("inverse", sort=False):
        for is_redundant, own in by_rule.groupby("is_redundant"):
            ideal, real = (own[own["variation"] == name] for name in (IDEAL_MOTORS, NOMINAL))
            settled = (100.0 * one["settled"].mean() for one in (ideal, real))
            yield (
                name_rule(word),
                REDUNDANT[is_redundant],
                next(settled),
                ideal["peak_torque_ratio"].max(),
                next(settled),
                1000.0 * real["position_error_m"].max(),
            )
