"""Lines on parts of a run that the paper's tables do not cover: controllers of arms, tasks in contact, perturbations."""

from collections.abc import Iterator

import pandas as pd

from bench.cli.details import PARTS
from bench.cli.screen import counted
from bench.cli.summary.lines import write_ratio, write_seconds
from bench.experiments.suites import IDEAL_MOTORS, NOMINAL
from bench.experiments.tables.statistics import quantile
from bench.findings.claims import Results
from bench.findings.claims.tables import settled, settling_times
from bench.findings.replication import NEARLY_ALL

MOST = 4
"""Controllers that are listed of an arm's plant or a task; the others are counted."""

CONTROLLER = 42
"""Width of the name of a controller."""

LOST = ("crashed", "hung")


def list_parts(results: Results) -> list[str]:
    """Return the parts of a run, as `show` names them, that have rows."""
    episodes = results.table("episodes")
    has = {"free-body": (episodes["arm"] == "").any(), "arms": (episodes["arm"] != "").any()}
    has |= {"contact": len(results.table("compliance")), "robustness": len(results.table("robustness"))}
    return [part for part in PARTS if has[part]]


def describe_arms(results: Results) -> Iterator[str]:
    """Yield a table of the controllers of arms for the plant as it is and with ideal motors."""
    episodes = results.table("episodes")
    rows = episodes[episodes["arm"] != ""]
    plants = {"": NOMINAL, ", ideal motors": IDEAL_MOTORS}
    for words, variation in plants.items():
        own = rows[rows["variation"].astype(str) == variation]
        if len(own):
            arms = ", ".join(own["arm"].astype(str).unique())
            yield f"{f'arms{words}: {arms}'[:CONTROLLER]:{CONTROLLER}} {'settles':>9} {'50 %':>6} {'99 %':>6} {'torque':>7}"
            yield from _list_controllers(own)
    others = rows[~rows["variation"].astype(str).isin((NOMINAL, IDEAL_MOTORS))]
    if len(others):
        good = int(settled(others).sum())
        yield f"arms with other motors or model errors: {good:,} of {len(others):,} episodes settle"


def _list_controllers(rows: pd.DataFrame) -> Iterator[str]:
    """Yield a line a controller, the one that settles most first. Torque: median peak over the rated one."""
    by_controller = {str(name): own for name, own in rows.groupby("contender", observed=True)}
    ranked = sorted(by_controller, key=lambda name: (-settled(by_controller[name]).mean(), name))
    for name in ranked[:MOST]:
        own = by_controller[name]
        times = settling_times(own)
        median, nearly_all = (write_seconds(float(quantile(times, level))) for level in (0.5, NEARLY_ALL))
        torque = write_ratio(float(own["peak_torque_ratio"].median()))
        count = f"{int(settled(own).sum())}/{len(own)}"
        if len(name) > CONTROLLER:
            yield name
            name = ""
        yield f"{name:{CONTROLLER}} {count:>9} {median:>6} {nearly_all:>6} {torque:>7}"
    if len(ranked) > MOST:
        yield f"and {counted(len(ranked) - MOST, 'controller')} more"


def describe_contact(results: Results) -> Iterator[str]:
    """Yield a line a task: at how many poses each controller does it."""
    rows = results.table("compliance")
    for task, own in rows.groupby("task", observed=True, sort=False):
        done = (own["outcome"] == "done").groupby(own["contender"].astype(str)).agg(["sum", "size"])
        done = done.assign(share=done["sum"] / done["size"]).sort_values("share", ascending=False, kind="stable")
        cells = [f"{name} {good}/{of}" for name, good, of in done[["sum", "size"]].itertuples()]
        more = [f"{len(cells) - MOST // 2} more"] if len(cells) > MOST // 2 else []
        yield f"{task}: done {', '.join(cells[: MOST // 2] + more)}"


def describe_robustness(results: Results) -> Iterator[str]:
    """Yield a line a perturbation of few: up to which level each law withstands it; of many, how many there are."""
    from bench.cli.details import robustness  # its closed forms take a second to import

    rows = results.table("robustness")
    axes = sorted(rows["axis"].astype(str).unique())
    if len(axes) > MOST:
        yield f"{counted(len(axes), 'perturbation')} of {counted(rows['contender'].nunique(), 'law')}"
        return
    summary = robustness.summary(rows)
    laws = summary[summary["law"] != robustness.NEAR]
    for way in [name for name in laws.columns[2:] if not str(name).endswith("theory")]:
        cells = [f"{law} {level}" for law, level in zip(laws["law"], laws[way], strict=True) if level]
        more = [f"{len(cells) - MOST} more"] if len(cells) > MOST else []
        yield f"withstands {way}: {', '.join(cells[:MOST] + more)}"


def describe_broken(results: Results) -> Iterator[str]:
    """Yield how many episodes a law ended by crashing or hanging."""
    tables = [results.table(name) for name in ("episodes", "robustness")]
    for law, outcome, number in _count_broken([table for table in tables if len(table)]):
        yield f"{law} {outcome} in {counted(number, 'episode')} (why: provenance.json, `lost`)"


def _count_broken(tables: list[pd.DataFrame]) -> list[tuple[str, str, int]]:
    lost = [table.loc[table["outcome"].isin(LOST), ["contender", "outcome"]] for table in tables]
    rows = pd.concat(lost).astype(str) if lost else pd.DataFrame(columns=["contender", "outcome"])
    if rows.empty:
        return []
    names = [rows["contender"].str.partition("@")[0], "outcome"]
    counts = rows.groupby(names).size().sort_values(ascending=False)
    return [(str(law), str(outcome), int(number)) for (law, outcome), number in counts.items()]


