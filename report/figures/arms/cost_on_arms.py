"""The page on the cost of arms: the share of the law, and whole controllers by stage on six joints and on seven.

What MuJoCo computes for every controller alike (D, fg, the forward kinematics) is not counted.
"""

from __future__ import annotations

import functools
import math

import pandas as pd

from bench.engines.counting import STAGES
from bench.findings.claims import Results, judge
from bench.findings.claims.controller_costs import INVERSES
from bench.findings.claims.standing import MEASURABLE
from bench.findings.selection.tables import ticks
from report.figures.arms import arm_rows
from report.figures.arms.arm_rows import ON_MATRIX
from report.figures.cost.operations import CALLS
from report.figures.kit import families, html
from report.figures.kit.page import Run, in_run
from report.figures.kit.rows import FEEDBACK, LINEARIZED, MATRIX

ON_LAW = ON_MATRIX.partition("@")[0]

LAW = ("goal", "represent", "regulate")
"""Stages that a free body has too: the orientation law and its coordinates."""


def facts(run: Run) -> dict:
    """Return the law's share of a tick, what the Euler Jacobian adds, and claim C26."""
    return {
        "measurable": f"{100 * MEASURABLE:g}",
        **(in_run(lambda: by_joints(counted(run))) or {}),
        **(in_run(lambda: share_of_time(run)) or {}),
        "c26": in_run(lambda: describe_claim(run)),
    }


def describe_claim(run: Run) -> str:
    """Return the verdict on C26 and its evidence."""
    c26 = judge("C26", Results(run.folder))
    return f"**{str(c26.word).capitalize()}.** {c26.evidence}"


def share_of_time(run: Run) -> dict[str, str]:
    """Return the shares of a whole controller's time that the cheapest law, late braking and the dearest take."""
    share = {law: value for law, value in ticks(Results(run.folder)).items() if not law.endswith("literal/zyx-euler")}
    most = max(share, key=lambda law: share[law])
    shown = {"time_matrix": ON_LAW, "time_late": "late-braking", "time_most": most}
    words = {key: percent(share[law] / 100.0) if law in share else html.MISSING for key, law in shown.items()}
    return words | {"time_most_law": families.word(most), "paper_order": order_papers_laws(share)}


def order_papers_laws(share: dict[str, float]) -> str:
    """State which of the paper's laws takes least time alone and which most, and whether the paper says so too."""
    least, _, most = sorted((MATRIX, LINEARIZED, FEEDBACK), key=lambda law: share.get(law, math.nan))
    agrees = "as" if (least, most) == (MATRIX, FEEDBACK) else "other than"
    names = f"{families.word(least)} is the cheapest and {families.word(most)} the dearest"
    return f"Alone, of the paper's three laws {names}, {agrees} the paper says"


def by_joints(rows: pd.DataFrame) -> dict[str, str]:
    """How much of a tick is the law, and what the Euler Jacobian adds, on six joints and on seven; of six in full."""
    found: dict[str, str] = {}
    for joints, key in ((6, "six"), (7, "seven")):
        own = standard(rows, joints)
        flops = stages(own)
        if {*arm_rows.PAPERS_TWO, arm_rows.SAME_BOTH_WAYS} <= set(flops.index):
            parts = shares(flops) | (in_full(flops, stages(own, "calls")) if joints == 6 else {})
            found |= {f"{key}_{name}": text for name, text in parts.items()}
    return found


def shares(flops: pd.DataFrame) -> dict[str, str]:
    """Return the law on R over its whole tick; what (3.7) takes more than that, and than (2.2) with its own law."""
    total = flops.sum(axis=1)
    angles = total[arm_rows.ON_ANGLES]
    return {
        "share": percent(flops.loc[ON_MATRIX, list(LAW)].sum() / total[ON_MATRIX]),
        "more": percent(angles / total[ON_MATRIX] - 1.0),
        "more_same": percent(angles / total[arm_rows.SAME_BOTH_WAYS] - 1.0),
    }


def in_full(flops: pd.DataFrame, calls: pd.DataFrame) -> dict[str, str]:
    """Flops of both controllers and of the stages of one, and between the cheapest law by (2.2) and the dearest."""
    total, matrix = flops.sum(axis=1), flops.loc[ON_MATRIX]
    laws = [name for name in flops.index if arm_rows.equation(name) == "(2.2)"]
    return {
        "matrix": str(total[ON_MATRIX]),
        "law": str(matrix[list(LAW)].sum()),
        "invert": str(matrix["invert"]),
        "linearize": str(matrix["linearize"]),
        "spread": percent(total[laws].max() / total[laws].min() - 1.0),
        "angles": str(total[arm_rows.ON_ANGLES]),
        "calls": str(calls.loc[arm_rows.ON_ANGLES].sum()),
    }


def percent(value: float) -> str:
    """0.0677 as 6.8 %."""
    return f"{100.0 * value:.2g}\N{NO-BREAK SPACE}%"


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
    """Return a row a controller, the cheapest first, a column a stage."""
    table = rows[rows["stage"] != "total"].pivot_table(index="controller", columns="stage", values=column, sort=False)
    table = table.reindex(columns=STAGES, fill_value=0).astype(int)
    return table.loc[table.sum(axis=1).sort_values(kind="stable").index]
