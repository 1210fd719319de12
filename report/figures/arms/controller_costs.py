"""What whole controllers of an arm cost a tick, by stage.

Counted like laws, on six joints and on seven. What MuJoCo computes for every controller alike (the inertia matrix D,
the torques fg, the forward kinematics) is not counted.
"""

from __future__ import annotations

import functools

import pandas as pd

from bench.engines.counting import STAGES
from bench.findings.claims.controller_costs import INVERSES
from report.figures.cost.operations import CALLS
from report.figures.kit.page import Run


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
