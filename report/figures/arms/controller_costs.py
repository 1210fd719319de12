"""What whole controllers of an arm cost a tick, by stage; and how little of it is the law that the paper is about.

Counted like laws, on six joints and on seven. What MuJoCo computes for every controller alike (the inertia matrix D,
the torques fg, the forward kinematics) is not counted.
"""

from __future__ import annotations

from textwrap import wrap

import pandas as pd

from bench.counting import STAGES
from bench.findings.claims.controller_costs import INVERSES
from bench.tables import read
from report.figures.arms import arm_rows
from report.figures.cost.operations import CALLS, ink
from report.figures.cost.prices import spent
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

COLOURS = {
    "measure": "#b9c3cf",
    "goal": "#e69f00",
    "represent": "#d55e00",
    "regulate": "#0072b2",
    "jacobian": "#009e73",
    "invert": "#cc79a7",
    "linearize": "#56b4e9",
}
MEANINGS = {
    "measure": "the tool's velocity and $\\dot J \\dot q$, from the joints' axes and rates",
    "goal": "coordinates of the goal",
    "represent": "coordinates of $R$, and their rates",
    "regulate": "the law",
    "jacobian": "$J$, or $J_E$",
    "invert": "the inverse, times the wanted acceleration",
    "linearize": "the rest of (2.2) or (3.7): what is between $u$ and $\\tau$",
}
LAW = ("goal", "represent", "regulate")
"""Stages that a free body has too: the orientation law and its coordinates."""

LETTERS, NARROW_LETTERS = 44, 30
LEAST_LABELLED = 0.035
"""A piece of a bar narrower than this share of the axis has no room for its number."""


def counted() -> pd.DataFrame:
    """Rows of costs.parquet about arms, typical branch, with `calls` and the controller without its inverse."""
    rows = read.costs(branch="typical")
    rows = rows[rows["joints"] > 0]
    names = rows["contender"].astype(str)
    return rows.assign(
        contender=names,
        controller=names.str.partition("+")[0],
        inverse=rows["inverse"].astype(str),
        stage=rows["stage"].astype(str),
        calls=rows[list(CALLS)].sum(axis=1),
    )


def standard(rows: pd.DataFrame, joints: int) -> pd.DataFrame:
    """Those by the inverse of the claims; of a controller that it does not fit, by the cheapest that fits."""
    own = rows[rows["joints"] == joints]
    totals = own[own["stage"] == "total"].sort_values("flops", kind="stable")
    kept = [
        (of[of["inverse"] == INVERSES[joints]]["contender"].tolist() or of["contender"].tolist())[0]
        for _, of in totals.groupby("controller", sort=False)
    ]
    return own[own["contender"].isin(kept)]


def stages(rows: pd.DataFrame, column: str = "flops") -> pd.DataFrame:
    """A row a controller, the cheapest first, a column a stage."""
    table = rows[rows["stage"] != "total"].pivot_table(index="controller", columns="stage", values=column, sort=False)
    table = table.reindex(columns=STAGES, fill_value=0).astype(int)
    return table.loc[table.sum(axis=1).sort_values(kind="stable").index]


@responsive_picture
def bars(rows: pd.DataFrame, *, narrow=False):
    """Stacked bars of flops by stage, a bar a controller on six joints."""
    own = standard(rows, 6)
    table, calls = stages(own), stages(own, "calls")
    if table.empty:
        figure, axes = style.panels(height=1.0, narrow=narrow)
        axes.axis("off")
        axes.text(0.5, 0.5, "Not in this run: it counted no controller.", ha="center", color=style.MUTED)
        return figure, "Flops a tick of whole controllers: not in this run."
    figure, axes = style.panels(height=1.0 + (0.66 if narrow else 0.36) * len(table), narrow=narrow)
    widest = int(table.sum(axis=1).max())
    left = pd.Series(0, index=table.index)
    for stage, colour in COLOURS.items():
        axes.barh(
            range(len(table)), table[stage], left=left, color=colour, height=0.64, label=stage, edgecolor=style.PAPER
        )
        for place, (start, width) in enumerate(zip(left, table[stage], strict=True)):
            if width > LEAST_LABELLED * widest * (2.2 if narrow else 1.2):
                axes.text(
                    start + width / 2, place, f"{width}", ha="center", va="center", fontsize=8.5, color=ink(colour)
                )
        left = left + table[stage]
    for place, name in enumerate(table.index):
        said = spent(int(left[name]), int(calls.loc[name].sum()))
        axes.text(left[name] + 0.01 * widest, place, said, va="center", fontsize=8.5, color=style.MUTED)
    names = ["\n".join(wrap(arm_rows.title(name), NARROW_LETTERS if narrow else LETTERS)) for name in table.index]
    if narrow:
        axes.set_yticks([])
        for place, name in enumerate(names):
            axes.text(0, place - 0.36, name.replace("\n", " "), va="bottom", fontsize=8)
    else:
        axes.set_yticks(range(len(table)), names)
    axes.set_xlim(0, 1.13 * widest)
    axes.set_ylim(len(table) - 0.5, -0.75 if narrow else -0.5)
    axes.set_xlabel("Flops a tick, six joints")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    figure.legend(loc="outside upper left", ncols=3 if narrow else 7, handlelength=1, columnspacing=1.1)
    words = "; ".join(
        f"{arm_rows.title(name)} {row.sum()}, of which {row['invert']} invert" for name, row in table.iterrows()
    )
    return figure, f"Flops a tick by stage, one bar a controller on six joints: {words}."


def by_stage(rows: pd.DataFrame, joints: int) -> html.Markdown:
    """The same as a table: flops, and after a plus the transcendental calls."""
    own = standard(rows, joints)
    flops, calls = stages(own), stages(own, "calls")
    lines = [
        {
            "Controller": arm_rows.title(name),
            **{stage: whole(int(flops.at[name, stage]), int(calls.at[name, stage])) for stage in STAGES},
            "total": whole(int(flops.loc[name].sum()), int(calls.loc[name].sum())),
        }
        for name in flops.index
    ]
    return html.table(pd.DataFrame(lines)) if lines else html.Markdown("| Costs |\n| :-- |\n| Not in this run. |")


def whole(flops: int, calls: int) -> html.Html:
    """Flops and calls, on one line."""
    return html.together(spent(flops, calls))


def meanings() -> html.Markdown:
    """What each stage is."""
    return html.table(pd.DataFrame([{"Stage": name, "What it computes": MEANINGS[name]} for name in STAGES]))


def facts(rows: pd.DataFrame) -> dict[str, str]:
    """How much of a tick is the law, and what the Euler Jacobian adds, on six joints and on seven."""
    found: dict[str, str] = {}
    for joints, key in ((6, "six"), (7, "seven")):
        own = standard(rows, joints)
        flops, calls = stages(own), stages(own, "calls")
        if not {arm_rows.ON_MATRIX, arm_rows.ON_ANGLES, arm_rows.SAME_BOTH_WAYS} <= set(flops.index):
            continue
        matrix, same, angles = (
            int(flops.loc[name].sum()) for name in (arm_rows.ON_MATRIX, arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)
        )
        laws = flops[list(LAW)].sum(axis=1)
        papers = [name for name in flops.index if arm_rows.equation(name) == "(2.2)"]
        papers = [name for name in papers if name.endswith("@geometric")]
        totals = flops.loc[papers].sum(axis=1)
        found |= {
            f"{key}_matrix": str(matrix),
            f"{key}_law": str(laws[arm_rows.ON_MATRIX]),
            f"{key}_share": percent(laws[arm_rows.ON_MATRIX] / matrix),
            f"{key}_spread": percent(totals.max() / totals.min() - 1.0),
            f"{key}_angles": str(angles),
            f"{key}_more": percent(angles / matrix - 1.0),
            f"{key}_more_same": percent(angles / same - 1.0),
            f"{key}_calls": str(int(calls.loc[arm_rows.ON_ANGLES].sum())),
            f"{key}_invert": str(int(flops.at[arm_rows.ON_MATRIX, "invert"])),
            f"{key}_linearize": str(int(flops.at[arm_rows.ON_MATRIX, "linearize"])),
            f"{key}_differentiated": differentiated(flops, angles),
        }
    return found


def differentiated(flops: pd.DataFrame, converted: int) -> str:
    """What (3.5) costs more than (3.3), of the whole tick; a dash where it was not counted."""
    name = arm_rows.ON_ANGLES.replace("@analytic", "@analytic-differentiated")
    return percent(int(flops.loc[name].sum()) / converted - 1.0) if name in flops.index else html.MISSING


def percent(value: float) -> str:
    """0.0677 as 6.8 %."""
    return f"{100.0 * value:.2g}\N{NO-BREAK SPACE}%"


def verdict(id: str) -> str:
    """A claim's word and evidence on this run, in a sentence for the page."""
    from bench.findings.claims import Results, judge

    one = judge(id, Results(read.folder()))
    return f"**{str(one.word).capitalize()}.** {one.evidence}"
