"""What the page on the cost of arms shows: whole controllers by stage, inverses and what they buy, time a tick."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pandas as pd

from bench.engines.counting import STAGES
from bench.findings.claims import Results, judge
from bench.findings.claims.standing import MEASURABLE
from bench.findings.selection.timed import ticks
from report.figures.arms import arm_rows, arm_times, controller_costs
from report.figures.arms.arm_rows import ON_MATRIX
from report.figures.kit import families, html
from report.figures.kit.page import Run, given
from report.figures.kit.rows import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.tables import Table

ON_LAW = ON_MATRIX.partition("@")[0]

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

MEANT = Table("Stage | What it computes")
PRICES = Table("Inverse | Flops, six joints | Flops, seven | Tick, six joints | Times the cheapest:.1f")
SAID = {
    "damped-least-squares": "Damping costs {times} times as much",
    "damped-least-squares-variable": "damping only where it is needed, to be exact elsewhere, {times} times",
    "truncated-svd": "leaving out small singular values, which takes their decomposition, {times} times",
}


def facts(run: Run) -> dict:
    """The law's share of a tick, what the Euler Jacobian adds, what damping costs, how long loops take, claim C26."""
    counted, c26 = controller_costs.counted(run), judge("C26", Results(run.folder))
    return {
        **by_joints(counted),
        **share_of_time(run),
        "measurable": f"{100 * MEASURABLE:g}",
        "inverses_said": price_of_damping(counted, arm_rows.episodes(run)),
        "said": arm_times.duration(run),
        "c26": f"**{str(c26.word).capitalize()}.** {c26.evidence}",
    }


def share_of_time(run: Run) -> dict[str, str]:
    """Return the shares of a whole controller's time that the cheapest law, late braking and the dearest take."""
    share = {law: value for law, value in ticks(Results(run.folder)).items() if not law.endswith("literal/zyx-euler")}
    if ON_LAW not in share:
        return {}
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


def tables(run: Run) -> dict:
    """Stages, inverses, times."""
    counted = controller_costs.counted(run)
    return {
        "meanings": MEANT((name, MEANINGS[name]) for name in STAGES),
        "inverses": PRICES(prices(counted)),
        "times": arm_times.by_arm(arm_times.rows(run)),
    }


def figures(run: Run) -> dict:
    """Stages of every controller."""
    return {"controller-costs": given(controller_costs.counted(run), controller_costs.bars)}


def by_joints(rows: pd.DataFrame) -> dict[str, str]:
    """How much of a tick is the law, and what the Euler Jacobian adds, on six joints and on seven; of six in full."""
    found: dict[str, str] = {}
    for joints, key in ((6, "six"), (7, "seven")):
        own = controller_costs.standard(rows, joints)
        flops = controller_costs.stages(own)
        if {*arm_rows.PAPERS_TWO, arm_rows.SAME_BOTH_WAYS} <= set(flops.index):
            parts = shares(flops) | (in_full(flops, controller_costs.stages(own, "calls")) if joints == 6 else {})
            found |= {f"{key}_{name}": text for name, text in parts.items()}
    return found


def shares(flops: pd.DataFrame) -> dict[str, str]:
    """The law on R over its whole tick; what (3.7) takes more than that, and than (2.2) with its own law."""
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
        "differentiated": differentiated(flops, total[arm_rows.ON_ANGLES]),
    }


def differentiated(flops: pd.DataFrame, converted: int) -> str:
    """What (3.5) costs more than (3.3), of the whole tick; a dash where it was not counted."""
    name = arm_rows.ON_ANGLES.replace("@analytic", "@analytic-differentiated")
    return percent(int(flops.loc[name].sum()) / converted - 1.0) if name in flops.index else html.MISSING


def percent(value: float) -> str:
    """0.0677 as 6.8 %."""
    return f"{100.0 * value:.2g}\N{NO-BREAK SPACE}%"


def on_square(episodes: pd.DataFrame) -> pd.DataFrame:
    """`wrist` starts by the law on R, on arms where the plain inverse fits."""
    wrist = episodes[(episodes["controller"] == ON_MATRIX) & (episodes["start_set"] == "wrist")]
    fits = {arm for arm in set(wrist["arm"]) if arm_rows.standard(arm, *ON_MATRIX.split("@")) == "solve"}
    return wrist[wrist["arm"].isin(fits)]


def invert(rows: pd.DataFrame) -> pd.DataFrame:
    """A row an inverse, the cheapest first: flops of the stage `invert` by the number of joints."""
    own = rows[(rows["controller"] == ON_MATRIX) & (rows["stage"] == "invert")]
    table = own.pivot_table(index="inverse", columns="joints", values="flops", sort=False)
    return table.loc[table.min(axis=1).sort_values(kind="stable").index]


def prices(rows: pd.DataFrame) -> Iterator[tuple]:
    """Every inverse: flops on six joints and on seven, none where it does not fit; the tick on six, over the cheapest.

    Args:
        rows: of `controller_costs.counted`.
    """
    table = invert(rows).reindex(columns=(6, 7))
    six = rows[(rows["controller"] == ON_MATRIX) & (rows["joints"] == 6) & (rows["stage"] == "total")]
    ticks = six.set_index("inverse")["flops"].reindex(table.index)
    for name, flops in table.iterrows():
        yield arm_rows.title_of_inverse(str(name)), *flops, ticks[name], ticks[name] / ticks.min()


def price_of_damping(rows: pd.DataFrame, episodes: pd.DataFrame) -> str:
    """What each kind of damping costs over the plain inverse on six joints, and how many `wrist` starts each loses."""
    table = invert(rows)
    flops = table[6].dropna() if 6 in table else pd.Series(dtype=float)
    if not {"solve", *SAID} <= set(flops.index):
        return "Not in this run: it has one inverse for a number of joints, and no damped one."
    wrist, parts = on_square(episodes), []
    for name in ("solve", *SAID):
        own = wrist[wrist["inverse"] == name]
        lost = f"loses {int((own['outcome'] != 'settled').sum())} of {len(own)} starts" if len(own) else "was not run"
        price = SAID[name].format(times=f"{flops[name] / flops['solve']:.1f}") if name in SAID else ""
        parts.append(f"{price} and {lost}" if price else f"The plain inverse {lost}.")
    return f"{parts[0]} {'; '.join(parts[1:])}."
