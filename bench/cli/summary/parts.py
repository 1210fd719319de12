"""Lines on what the paper's tables do not cover: controllers of arms, tasks in contact, perturbations."""

from collections.abc import Iterator

import pandas as pd

from bench.cli.details import PARTS
from bench.cli.screen import counted
from bench.cli.summary.lines import write_ratio, write_seconds
from bench.experiments.suites import IDEAL_MOTORS, NOMINAL
from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import quantile
from bench.findings.claims.tables import settled, settling_times
from bench.findings.replication import NEARLY_ALL

FEW, MANY = 4, 10
"""Controllers of arms that are listed beside the paper's laws, and where there are none; the others are counted."""

OF_TASK = 6
"""Controllers that are listed of a task in contact."""

AXES = 8
"""Perturbations up to which each has a line, and laws in a line."""

CONTROLLER = 42
"""Width of the name of a controller."""


def list_parts(run: Run) -> list[str]:
    """Return the parts of a run, as `show` names them, that have rows."""
    episodes = run.table("episodes")
    has = {
        "free-body": (episodes["arm"] == "").any(),
        "arms": (episodes["arm"] != "").any(),
    }
    has |= {
        "contact": len(run.table("compliance")),
        "robustness": len(run.table("robustness")),
    }
    return [part for part in PARTS if has[part]]


def describe_arms(run: Run, most: int) -> Iterator[str]:
    """Yield a table of so many controllers of arms, for the plant as it is and with ideal motors."""
    episodes = run.table("episodes")
    rows = episodes[episodes["arm"] != ""]
    variation = rows["variation"].astype(str)
    plants = {
        "": rows[variation == NOMINAL],
        ", ideal motors": rows[variation == IDEAL_MOTORS],
    }
    plants = {words: own for words, own in plants.items() if len(own)}
    for words, own in plants.items():
        arms = ", ".join(own["arm"].astype(str).unique())
        head = f"arms{words}: {arms}"[:CONTROLLER]
        yield f"{head:{CONTROLLER}} {'settles':>9} {'50 %':>6} {'99 %':>6} {'torque':>7}"
        yield from _list_controllers(own, most // len(plants))
    others = rows[~variation.isin((NOMINAL, IDEAL_MOTORS))]
    if len(others):
        good = int(settled(others).sum())
        yield f"arms with other motors or model errors: {good:,} of {len(others):,} episodes settle"


def _list_controllers(rows: pd.DataFrame, most: int) -> Iterator[str]:
    """Yield a line a controller, the one that settles most first. Torque: median peak over the rated one."""
    by_controller = {
        str(name): own for name, own in rows.groupby("contender", observed=True)
    }
    ranked = sorted(
        by_controller, key=lambda name: (-settled(by_controller[name]).mean(), name)
    )
    for name in ranked[:most]:
        own = by_controller[name]
        times = settling_times(own)
        median, nearly_all = (
            write_seconds(float(quantile(times, level))) for level in (0.5, NEARLY_ALL)
        )
        torque = write_ratio(float(own["peak_torque_ratio"].median()))
        count = f"{int(settled(own).sum())}/{len(own)}"
        if len(name) > CONTROLLER:
            yield name
            name = ""
        yield f"{name:{CONTROLLER}} {count:>9} {median:>6} {nearly_all:>6} {torque:>7}"
    if len(ranked) > most:
        yield f"and {counted(len(ranked) - most, 'controller')} more"


def describe_contact(run: Run) -> Iterator[str]:
    """Yield a line a task: at how many poses each controller does it."""
    rows = run.table("compliance")
    for task, own in rows.groupby("task", observed=True, sort=False):
        done = (
            (own["outcome"] == "done")
            .groupby(own["contender"].astype(str))
            .agg(["sum", "size"])
        )
        done = done.assign(share=done["sum"] / done["size"]).sort_values(
            "share", ascending=False, kind="stable"
        )
        cells = [
            f"{name} {good}/{of}"
            for name, good, of in done[["sum", "size"]].itertuples()
        ]
        more = [f"{len(cells) - OF_TASK} more"] if len(cells) > OF_TASK else []
        yield f"{task}, done: {', '.join(cells[:OF_TASK] + more)}"


def describe_robustness(run: Run) -> Iterator[str]:
    """Yield a line a perturbation of few: up to which level each law withstands it; of many, how many there are."""
    from bench.cli.details import robustness  # its closed forms take a second to import

    rows = run.table("robustness")
    axes = sorted(rows["axis"].astype(str).unique())
    if len(axes) > AXES:
        yield f"{counted(len(axes), 'perturbation')} of {counted(rows['contender'].nunique(), 'law')}"
        return
    summary = robustness.summary(rows)
    laws = summary[summary["law"] != robustness.NEAR]
    for way in [name for name in laws.columns[2:] if not str(name).endswith("theory")]:
        cells = [
            f"{law} {level}"
            for law, level in zip(laws["law"], laws[way], strict=True)
            if level
        ]
        more = [f"{len(cells) - AXES} more"] if len(cells) > AXES else []
        yield f"{way}, withstood up to: {', '.join(cells[:AXES] + more)}"
