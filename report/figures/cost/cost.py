"""What the page on cost shows: operations by kind, the price of the literal form, and time a tick."""

from __future__ import annotations

import functools

import pandas as pd

from bench.engines.counting import OPERATIONS
from bench.experiments.tables import read
from bench.law.contenders.registry import all_contenders
from report.figures.cost import operations, times
from report.figures.cost.operations import CALLS
from report.figures.kit import html, laws
from report.figures.kit.page import Run
from report.figures.kit.rows import FEEDBACK
from report.figures.kit.tables import Table

TIMES = Table(
    "Law | Flops | Kernel steps:.2f | 95 % interval | ns:.0f | ideal-rk4, ns:.0f | ideal-held, ns:.0f | native, ns:.0f"
)
LEAN = {"lean": FEEDBACK, "literal": next(one.name for one in all_contenders() if one.regulator.costing_only)}
"""The linearizing law as we write it and as it is printed."""


@functools.cache
def costs(run: Run) -> pd.DataFrame:
    """Operations of the paper's laws and the user's own."""
    return laws.without_later(run.rows("costs", **read.FREE_BODY))


def timed(run: Run) -> pd.DataFrame:
    """Their times on the first machine that has any."""
    files = times.files(run)
    none = pd.DataFrame(columns=["contender", "what", "jacobian", "ticks", "ratio"])
    return laws.without_later(times.read(files[0])) if files else none


def facts(run: Run) -> dict:
    """Return the literal form against the lean one, and on which machine times were measured."""
    counted = costs(run)
    values: dict = {}
    for key, name in LEAN.items():
        spent_by = totals(counted).loc[name]
        values[f"{key}_flops"], values[f"{key}_div"] = int(spent_by["flops"]), int(spent_by["div"])
        values[f"{key}_calls"] = int(spent_by[list(CALLS)].sum())
    return values | {
        "branches": f"{len(branches_differ(counted))} of {counted['contender'].nunique()}",
        "timed_on": times.said(run),
    }


def tables(run: Run) -> dict:
    """Return the tables of times."""
    return {"tab_times": TIMES(by_time(timed(run), costs(run)))}


def figures(run: Run) -> dict:
    """Operations by kind."""
    return {"operations": operations.operations(costs(run))}


def spent(flops: int, calls: int) -> str:
    """Return flops and calls, as "45 + 6"."""
    return f"{flops} + {calls}" if calls else (f"{flops}" if flops else html.MISSING)


def totals(counted: pd.DataFrame) -> pd.DataFrame:
    """Return the row "total" of every contender's typical branch, by contender."""
    return counted[(counted["branch"] == "typical") & (counted["stage"] == "total")].set_index("contender")


def branches_differ(counted: pd.DataFrame) -> list[str]:
    """Contenders whose worst branch costs other than their typical one."""
    both = counted[counted["stage"] == "total"].set_index(["contender", "branch"])[[*OPERATIONS]]
    names = both.index.get_level_values("contender").unique()
    return [name for name in names if (both.loc[(name, "typical")] != both.loc[(name, "worst")]).any()]


def by_time(measured: pd.DataFrame, counted: pd.DataFrame) -> list[tuple]:
    """Return a row a law, the fastest first: flops, time a tick alone, and on the free body in each engine."""
    lines, flops = [], totals(counted)["flops"]
    on_body = measured[(measured["contender"] != "") & (measured["jacobian"] == "")]
    for name, own in on_body.groupby("contender", sort=False):
        law = own[own["what"] == "law"].iloc[0]
        loops = own[own["what"] == "engine"].set_index("engine")["ns_per_tick"]
        interval = f"{law['ratio_low']:.2f} to {law['ratio_high']:.2f}"
        alone = html.law(name, laws.title(name)), flops.get(name), law["ratio"], interval, law["ns_per_tick"]
        lines.append((*alone, *(loops.get(engine) for engine in ("ideal-rk4", "ideal-held", "native"))))
    return sorted(lines, key=lambda line: line[2])
