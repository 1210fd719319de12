"""What the page on cost shows: operations by kind and stage, the price of the literal form, time a tick, the plane."""

from __future__ import annotations

import functools

import pandas as pd

from bench.counting import OPERATIONS, STAGES
from bench.findings.claims.costs import CALL_PRICE, CALL_PRICES, DEAR, SETTLED_SHARE, SLOW
from bench.tables import read
from report.figures.cost import operations, plane, times
from report.figures.cost.operations import CALLS
from report.figures.kit import html, laws, rows
from report.figures.kit.page import Run
from report.figures.kit.rows import titles

NO_TIMINGS = html.Markdown("| No timings |\n| :-- |\n| `make time` measures them and writes one file a machine. |")
LEAN = {"lean": "feedback-linearized/zyx-euler", "literal": "feedback-linearized-literal/zyx-euler"}
"""The linearizing law as we write it and as it is printed."""


@functools.cache
def costs(run: Run) -> pd.DataFrame:
    """Operations of the paper's laws and the user's own."""
    return laws.without_later(run.rows("costs", **read.FREE_BODY))


@functools.cache
def episodes(run: Run) -> pd.DataFrame:
    """Their episodes on the free body."""
    return laws.without_later(run.rows("episodes", task="free-body"))


def timed() -> pd.DataFrame:
    """Their times on the first machine that has any."""
    files = times.files()
    none = pd.DataFrame(columns=["contender", "what", "jacobian", "ticks", "ratio"])
    return laws.without_later(times.read(files[0])) if files else none


def facts(run: Run) -> dict:
    """The literal form against the lean one; what a call is taken for; what adequate means; time against flops."""
    counted = costs(run)
    totals = {key: total(counted, name) for key, name in LEAN.items()}
    values: dict = {}
    for key, spent_by in totals.items():
        values[f"{key}_flops"], values[f"{key}_div"] = int(spent_by["flops"]), int(spent_by["div"])
        values[f"{key}_calls"] = int(spent_by[list(CALLS)].sum())
    return values | {
        "spared": f"{1 - totals['lean']['flops'] / totals['literal']['flops']:.0%}",
        "branches": f"{len(branches_differ(counted))} of {counted['contender'].nunique()}",
        "timed_on": times.said(),
        "against_time": against_time(times.alone(timed()), counted),
        "price": f"{CALL_PRICE:.0f}",
        "low": f"{CALL_PRICES[0]:.0f}",
        "high": f"{CALL_PRICES[1]:.0f}",
        "share": f"{SETTLED_SHARE:.1%}".replace("%", " %"),
        "slow_s": f"{SLOW * rows.small_error_settling_s(episodes(run)):.2f}",
        "dear": f"{DEAR:.0f}",
        "n": rows.uniform_starts(episodes(run)),
    }


def tables(run: Run) -> dict:
    """Operations by kind, by stage, and times."""
    return {"tab_operations": by_operation(costs(run)), "stages": by_stage(costs(run)), "tab_times": by_time(timed())}


def figures(run: Run) -> dict:
    """Operations, time against flops, and the cost-performance plane."""
    counted, runs = costs(run), episodes(run)
    uniform = runs[(runs["engine"] == "ideal-rk4") & (runs["start_set"] == "uniform")]
    return {
        "operations": operations.operations(counted, titles()),
        "times": times.times(times.alone(timed()), counted, titles()),
        "plane": plane.plane(plane.places(counted, uniform), titles(), rows.small_error_settling_s(runs)),
    }


def named(name: str) -> html.Html:
    """A law by its title."""
    return html.law(name, titles().get(name, name))


def by_operation(counted: pd.DataFrame) -> html.Markdown:
    """A row a law: every operation that any law uses, then flops and transcendental calls."""
    total = counted[(counted["branch"] == "typical") & (counted["stage"] == "total")]
    used = [name for name in OPERATIONS if total[name].any()]
    frame = total[["contender", *used, "flops"]].assign(calls=total[list(CALLS)].sum(axis=1))
    frame = frame.sort_values(["flops", "calls"], kind="stable")
    frame["contender"] = [named(name) for name in frame["contender"]]
    return html.table(frame.rename(columns={"contender": "Law", "compare": "<", "copysign": "sign"}))


def by_stage(counted: pd.DataFrame) -> html.Markdown:
    """A row a law, a column a stage of the tick: flops, and after a plus the transcendental calls."""
    typical = counted[counted["branch"] == "typical"]
    used = [stage for stage in STAGES if typical.loc[typical["stage"] == stage, ["flops", *CALLS]].to_numpy().any()]
    lines = []
    for name, own in typical.groupby("contender", observed=True):
        own = own.set_index("stage")
        line: dict = {"Law": named(name)}
        for stage in (*used, "total"):
            line[stage] = spent(int(own.at[stage, "flops"]), int(own.loc[stage, list(CALLS)].sum()))
        lines.append((int(own.at["total", "flops"]), line))
    return html.table(pd.DataFrame([line for _, line in sorted(lines, key=lambda pair: pair[0])]))


def spent(flops: int, calls: int) -> str:
    """ "45 + 6": flops and calls."""
    return f"{flops} + {calls}" if calls else (f"{flops}" if flops else html.MISSING)


def total(counted: pd.DataFrame, contender: str) -> pd.Series:
    """The row "total" of one contender."""
    own = counted[(counted["contender"] == contender) & (counted["branch"] == "typical")]
    return own[own["stage"] == "total"].iloc[0]


def branches_differ(counted: pd.DataFrame) -> list[str]:
    """Contenders whose worst branch costs other than their typical one."""
    totals = counted[counted["stage"] == "total"].set_index(["contender", "branch"])[[*OPERATIONS]]
    names = totals.index.get_level_values("contender").unique()
    return [name for name in names if (totals.loc[(name, "typical")] != totals.loc[(name, "worst")]).any()]


def by_time(measured: pd.DataFrame) -> html.Markdown:
    """A row a law: time a tick alone and on the free body in each engine; empty where it was not measured."""
    lines = []
    on_body = measured[(measured["contender"] != "") & (measured["jacobian"] == "")]
    for name, own in on_body.groupby("contender", sort=False):
        alone = own[own["what"] == "law"].iloc[0]
        loops = own[own["what"] == "engine"].set_index("engine")["ns_per_tick"]
        line = {
            "Law": named(name),
            "Kernel steps": alone["ratio"],
            "95 % interval": f"{alone['ratio_low']:.2f} to {alone['ratio_high']:.2f}",
            "ns": alone["ns_per_tick"],
            **{f"{engine}, ns": loops.get(engine) for engine in ("ideal-rk4", "ideal-held", "native")},
        }
        lines.append(line)
    if not lines:
        return NO_TIMINGS
    frame = pd.DataFrame(lines).sort_values("Kernel steps")
    return html.table(frame, {"Kernel steps": ".2f", **{name: ".0f" for name in frame if name.endswith("ns")}})


def against_time(alone: pd.DataFrame, counted: pd.DataFrame) -> str:
    """A sentence on the two laws whose times differ most for what their flops differ; without times, on the counts."""
    totals = counted[(counted["branch"] == "typical") & (counted["stage"] == "total")].set_index("contender")
    both = [
        (row.contender, int(totals.at[row.contender, "flops"]), row.ratio)
        for row in alone.itertuples()
        if row.contender in totals.index
    ]
    pairs = [(one, two) for one in both for two in both if one != two]
    if pairs:
        one, two = max(pairs, key=lambda pair: pair[0][2] / pair[1][2] * pair[1][1] / pair[0][1])
        return (
            f"{titles()[one[0]]} takes {one[1]} flops and {titles()[two[0]]} {two[1]}, "
            f"yet the first takes {one[2] / two[2]:.1f} times as long."
        )
    calls = totals[list(CALLS)].sum(axis=1)
    return f"Up to {calls.max()} calls a tick stand outside the flops, and no count says what one of them takes."
