"""What each rule for a singular operational-space inertia does beside the singularities of arms."""

from collections.abc import Iterator

import pandas as pd

from bench.experiments.suites import IDEAL_MOTORS, LISTS, NOMINAL
from bench.law.contenders.registry import contenders
from report.figures.arms import arm_rows
from report.figures.kit.page import NotInRun, Run, in_run
from report.figures.kit.tables import Table

RULES = Table(
    "Λ | Arms | Settled, ideal motors [%] | Largest torque, of the rated one:.3g | Settled, motors cut [%] "
    "| Tool off its place, at most [mm]"
)
START_SET, INVERSE = "wrist", "dynamically-consistent"
REDUNDANT = {False: "six joints", True: "Panda"}


def tables(run: Run) -> dict:
    """Return the rules."""
    return {"rules": in_run(lambda: RULES(compare_rules(find_rows(run))))}


def facts(run: Run) -> dict:
    """Return how many starts there are, and what the rules do."""
    return {
        "starts": in_run(lambda: find_rows(run).groupby("arm")["start_id"].nunique().sum()),
        "said": in_run(lambda: describe_rules(find_rows(run))),
    }


def describe_rules(rows: pd.DataFrame) -> str:
    """Say what the rules do on arms of six joints, with ideal motors and as they are, and on the Panda."""
    six, panda = rows[~rows["is_redundant"]], rows[rows["is_redundant"]]
    ideal, real = (six[six["variation"] == name] for name in (IDEAL_MOTORS, NOMINAL))
    shares, torques = (ideal.groupby("inverse")[column] for column in ("settled", "peak_torque_ratio"))
    settled, torque, cut = 100.0 * shares.mean(), torques.max(), 100.0 * real.groupby("inverse")["settled"].mean()
    others, drift = settled.index != INVERSE, 1000.0 * real.groupby("inverse")["position_error_m"].max()
    return (
        f"On arms of six joints with ideal motors, the inverse settles {settled[INVERSE]:.0f} % and needs up to "
        f"{torque[INVERSE]:,.0f} times the rated torque. The other rules settle {settled[others].min():.0f} to "
        f"{settled[others].max():.0f} %, with up to {torque[others].max():,.0f} times. If the motors are cut, "
        f"{cut[INVERSE]:.0f} % settle with the inverse and {cut[others].min():.0f} to {cut[others].max():.0f} % with "
        f"the others. Meanwhile the tool leaves its place by up to {drift.min():.0f} mm ({name_rule(drift.idxmin())}) "
        f"to {drift.max():.0f} mm ({name_rule(drift.idxmax())}). On the Panda, {100 * panda['settled'].mean():.0f} % "
        "settle."
    )


def find_rows(run: Run) -> pd.DataFrame:
    """Return the episodes that begin beside a singularity, by every rule."""
    rows = arm_rows.every(run)
    rows = rows[rows["way"].isin(LISTS["OPERATIONAL"]) & (rows["start_set"] == START_SET)]
    if rows.empty:
        raise NotInRun("no operational-space torque beside a singularity")
    return rows.assign(settled=arm_rows.settled(rows), is_redundant=rows["arm"] == "panda")


def name_rule(word: str) -> str:
    """Return what the page calls a rule."""
    return "inverse" if word == INVERSE else contenders("inverses")[word].title.removeprefix("Operational space, ")


def compare_rules(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a rule and number of joints."""
    for word, by_rule in rows.groupby("inverse", sort=False):
        for is_redundant, own in by_rule.groupby("is_redundant"):
            ideal, real = (own[own["variation"] == name] for name in (IDEAL_MOTORS, NOMINAL))
            settled = (f"{100 * one['settled'].mean():.0f}" for one in (ideal, real))
            yield (
                name_rule(word),
                REDUNDANT[is_redundant],
                next(settled),
                ideal["peak_torque_ratio"].max(),
                next(settled),
                f"{1000 * real['position_error_m'].max():.0f}",
            )
