"""The tables of cost: operations by kind and stage, the price of the literal form, time a tick."""

from __future__ import annotations

import pandas as pd

from bench.counting import OPERATIONS, STAGES
from report.figures.cost.operations import CALLS
from report.figures.kit import html


def operations(costs: pd.DataFrame, titles: dict[str, str], branch: str = "typical") -> html.Markdown:
    """A row a law: every operation that any law uses, then flops and transcendental calls."""
    rows = costs[(costs["branch"] == branch) & (costs["stage"] == "total")]
    used = [name for name in OPERATIONS if rows[name].any()]
    frame = rows[["contender", *used, "flops"]].copy()
    frame["calls"] = rows[list(CALLS)].sum(axis=1)
    frame = frame.sort_values(["flops", "calls"], kind="stable")
    frame["contender"] = [html.law(name, titles.get(name, name)) for name in frame["contender"]]
    return html.table(frame.rename(columns={"contender": "Law", "compare": "<", "copysign": "sign"}))


def stages(costs: pd.DataFrame, titles: dict[str, str], branch: str = "typical") -> html.Markdown:
    """A row a law, a column a stage of the tick: flops, and after a plus the transcendental calls."""
    rows = costs[costs["branch"] == branch]
    used = [stage for stage in STAGES if rows.loc[rows["stage"] == stage, ["flops", *CALLS]].to_numpy().any()]
    lines = []
    for name, own in rows.groupby("contender", observed=True):
        own = own.set_index("stage")
        line: dict = {"Law": html.law(name, titles.get(name, name))}
        for stage in (*used, "total"):
            line[stage] = spent(int(own.at[stage, "flops"]), int(own.loc[stage, list(CALLS)].sum()))
        lines.append((int(own.at["total", "flops"]), line))
    ordered = [line for _, line in sorted(lines, key=lambda pair: pair[0])]
    return html.table(pd.DataFrame(ordered))


def spent(flops: int, calls: int) -> str:
    """ "45 + 6": flops and calls."""
    return f"{flops} + {calls}" if calls else (f"{flops}" if flops else html.MISSING)


def total(costs: pd.DataFrame, contender: str, branch: str = "typical") -> pd.Series:
    """The row "total" of one contender."""
    rows = costs[(costs["contender"] == contender) & (costs["branch"] == branch) & (costs["stage"] == "total")]
    return rows.iloc[0]


def branches_differ(costs: pd.DataFrame) -> list[str]:
    """Contenders whose worst branch costs other than their typical one."""
    totals = costs[costs["stage"] == "total"].set_index(["contender", "branch"])[[*OPERATIONS]]
    names = totals.index.get_level_values("contender").unique()
    return [name for name in names if (totals.loc[(name, "typical")] != totals.loc[(name, "worst")]).any()]


def times(rows: pd.DataFrame, titles: dict[str, str]) -> html.Markdown:
    """A row a law: time a tick alone and on the free body in each engine; empty where it was not measured."""
    lines = []
    on_body = rows[(rows["contender"] != "") & (rows["jacobian"] == "")]
    for name, own in on_body.groupby("contender", sort=False):
        alone = own[own["what"] == "law"].iloc[0]
        loops = own[own["what"] == "engine"].set_index("engine")["ns_per_tick"]
        line = {
            "Law": html.law(name, titles.get(name, name)),
            "Kernel steps": alone["ratio"],
            "95 % interval": f"{alone['ratio_low']:.2f} to {alone['ratio_high']:.2f}",
            "ns": alone["ns_per_tick"],
            **{f"{engine}, ns": loops.get(engine) for engine in ("ideal-rk4", "ideal-held", "native")},
        }
        lines.append(line)
    if not lines:
        return html.Markdown("| No timings |\n| :-- |\n| `make time` measures them and writes one file a machine. |")
    frame = pd.DataFrame(lines).sort_values("Kernel steps")
    return html.table(frame, {"Kernel steps": ".2f", **{name: ".0f" for name in frame if name.endswith("ns")}})


def against_time(alone: pd.DataFrame, costs: pd.DataFrame, titles: dict[str, str]) -> str:
    """A sentence on the two laws whose times differ most for what their flops differ; without times, on the counts."""
    totals = costs[(costs["branch"] == "typical") & (costs["stage"] == "total")].set_index("contender")
    rows = [
        (row.contender, int(totals.at[row.contender, "flops"]), row.ratio)
        for row in alone.itertuples()
        if row.contender in totals.index
    ]
    pairs = [(one, two) for one in rows for two in rows if one != two]
    if pairs:
        one, two = max(pairs, key=lambda pair: pair[0][2] / pair[1][2] * pair[1][1] / pair[0][1])
        return (
            f"{titles.get(one[0], one[0])} takes {one[1]} flops and {titles.get(two[0], two[0])} {two[1]}, "
            f"yet the first takes {one[2] / two[2]:.1f} times as long."
        )
    calls = totals[list(CALLS)].sum(axis=1)
    return f"Up to {calls.max()} calls a tick stand outside the flops, and no count says what one of them takes."
