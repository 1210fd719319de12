"""What whole controllers of an arm cost a tick, by stage.

Counted like laws, on six joints and on seven. What MuJoCo computes for every controller alike (the inertia matrix D,
the torques fg, the forward kinematics) is not counted.
"""

from __future__ import annotations

import functools
from textwrap import wrap

import pandas as pd

from bench.engines.counting import STAGES
from bench.findings.claims.controller_costs import INVERSES
from report.figures.arms import arm_rows
from report.figures.cost.cost import spent
from report.figures.cost.operations import CALLS, stack
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run

COLOURS = {
    "measure": "#b9c3cf",
    "goal": "#e69f00",
    "represent": "#d55e00",
    "regulate": "#0072b2",
    "jacobian": "#009e73",
    "invert": "#cc79a7",
    "linearize": "#56b4e9",
}
LETTERS, NARROW_LETTERS = 44, 30
LEAST_LABELLED = 0.035
"""A piece of a bar narrower than this share of the axis has no room for its number."""


@functools.cache
def counted(run: Run) -> pd.DataFrame:
    """Rows of costs.parquet about arms, typical branch, with `calls` and the controller without its inverse."""
    return prepared(run.rows("costs", branch="typical"))


def prepared(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows about arms, with `calls` and the controller without its inverse."""
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
    """Return the rows by the inverse of the claims; of a controller that it does not fit, by the cheapest that fits."""
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
    figure, axes = style.panels(height=1.0 + (0.66 if narrow else 0.36) * len(table), narrow=narrow)
    widest = int(table.sum(axis=1).max())
    left = stack(axes, table, COLOURS, 0.64, LEAST_LABELLED * widest * (2.2 if narrow else 1.2))
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
    style.listed(axes)
    figure.legend(loc="outside upper left", ncols=3 if narrow else 7, handlelength=1, columnspacing=1.1)
    words = "; ".join(
        f"{arm_rows.title(name)} {row.sum()}, of which {row['invert']} invert" for name, row in table.iterrows()
    )
    return figure, f"Flops a tick by stage, one bar a controller on six joints: {words}."
