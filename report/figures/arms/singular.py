"""What each rule for a singular operational-space inertia does beside the singularities of arms."""

from collections.abc import Iterator

import pandas as pd

from bench.experiments.suites import IDEAL_MOTORS, LISTS, NOMINAL, SINGULAR
from bench.law.contenders.registry import contenders
from report.figures.arms import arm_rows
from report.figures.kit.page import NotInRun, Run, in_run
from report.figures.kit.tables import Table

RULES = Table(
    "Λ | Arms | Ideal motors: settled [%] | Largest torque, of the rated one:.3g | As they are: settled [%] "
    "| Tool off its place, at most [mm]"
)
REDUNDANT = {False: "six joints", True: "Panda"}


def tables(run: Run) -> dict:
    """Return the rules."""
    return {"rules": in_run(lambda: RULES(compare_rules(find_rows(run))))}


def facts(run: Run) -> dict:
    """Return how many starts there are."""
    return {"starts": in_run(lambda: find_rows(run).groupby("arm")["start_id"].nunique().sum())}


def find_rows(run: Run) -> pd.DataFrame:
    """Return the episodes that begin beside a singularity, by every rule."""
    rows = arm_rows.every(run)
    rows = rows[rows["way"].isin(LISTS["OPERATIONAL"]) & rows["start_set"].isin(SINGULAR)]
    if rows.empty:
        raise NotInRun("no operational-space torque beside a singularity")
    return rows.assign(settled=arm_rows.settled(rows), is_redundant=rows["arm"] == "panda")


def compare_rules(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a rule and number of joints."""
    for word, by_rule in rows.groupby("inverse", sort=False):
        title = contenders("inverses")[word].title.removeprefix("Operational space, ").lower()
        for is_redundant, own in by_rule.groupby("is_redundant"):
            ideal, real = (own[own["variation"] == name] for name in (IDEAL_MOTORS, NOMINAL))
            settled = (f"{100 * one['settled'].mean():.0f}" for one in (ideal, real))
            yield (
                {"dynamically consistent": "inverse"}.get(title, title),
                REDUNDANT[is_redundant],
                next(settled),
                ideal["peak_torque_ratio"].max(),
                next(settled),
                f"{1000 * real['position_error_m'].max():.0f}",
            )
