"""Which controllers settle within rated torque and joint range, from evenly spread starts and from `reach`."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from bench.findings.claims.tables import Share, share
from bench.findings.on_arms import best, passed
from report.figures.arms import arm_rows
from report.figures.kit import html
from report.figures.kit.spelling import listed
from report.figures.kit.tables import Table

RANKED = Table("Controller | Settled [%] | Within limits | Reach, settled | Reach, within limits")
SETS = ("uniform", "reach")
COLUMNS = tuple((name, measure) for name in SETS for measure in ("settled", "range"))
FEW = 4
"""Names up to this number are said, more are counted; the table has them."""


def of_laws(rows: pd.DataFrame, start_set: str) -> pd.DataFrame:
    """Episodes of the laws by the paper's two Jacobians and the standard inverse, from one set."""
    return arm_rows.with_standard(rows[rows["start_set"] == start_set])


def ranked(rows: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a controller, best within torque and range first; bold: shares that no other controller beats.

    Args:
        rows: of `arm_rows.episodes`.
    """
    own = pd.concat([arm_rows.with_standard(rows), arm_rows.of_baselines(rows)])
    own = own[own["start_set"].isin(SETS)]
    own = own.assign(**passed(own))
    top = {
        (name, measure): best(own[own["start_set"] == name], measure, "controller")
        if name in set(own["start_set"])
        else []
        for name, measure in COLUMNS
    }
    means = own[own["start_set"] == SETS[0]].groupby("controller")["range"].mean()
    for controller in means.sort_values(ascending=False, kind="stable").index:
        cells = []
        for name, measure in COLUMNS:
            mine = own.loc[(own["controller"] == controller) & (own["start_set"] == name), measure]
            text = in_short(share(mine)) if len(mine) else html.MISSING
            cells.append(f"**{text}**" if controller in top[name, measure] else text)
        yield arm_rows.title(controller), *cells


def in_short(found: Share) -> str:
    """Return the percentage with its interval, 55 (46 to 63), on one line."""
    text = f"{100 * found.value:.0f} ({100 * found.low:.0f} to {100 * found.high:.0f})"
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def describe_share(rows: pd.DataFrame, controller: str, measure: str) -> str:
    """Share of a controller's episodes that pass, with its interval and n, in words."""
    own = passed(rows[rows["controller"] == controller])[measure]
    found = share(own)
    return f"{100 * found.value:.0f} % ({100 * found.low:.0f} to {100 * found.high:.0f} %, n = {found.n})"


def lead(uniform: pd.DataFrame) -> str:
    """Who is best within torque and range, what the Euler controller does, who settles most, and the torques.

    Args:
        uniform: of `of_laws`, evenly spread starts.
    """
    over = uniform["peak_torque_ratio"] > 1.0
    passes = passed(uniform)["range"].groupby(uniform["arm"]).any()
    never = [arm_rows.name_arm(arm) for arm in passes.index[~passes]]
    others = uniform[uniform["arm"].map(passes)]
    is_split = bool(never) and len(others) > 0
    first = describe_share(others, best(uniform, "range", "controller")[0], "range") if is_split else ""
    on_others = f"; on the others the best law passes {first}" if is_split else ""
    return (
        f"Limits of torques and joints are not simulated: of {len(uniform)} episodes of the laws from evenly spread "
        f"starts, {100 * over.mean():.0f} % exceed a rated torque. Counting only episodes within rated torque and "
        f"joint range, {leading(uniform, 'range')}. The paper's Euler controller (3.7) settles "
        f"{describe_share(uniform, arm_rows.ON_ANGLES, 'range')}. Arms on which no law passes: "
        f"{', '.join(never) or 'none'}{on_others}. Counting settling alone, {leading(uniform, 'settled')}."
    )


def leading(rows: pd.DataFrame, measure: str) -> str:
    """Which law passes most, or which are not distinguished from it, in words."""
    names = best(rows, measure, "controller")
    share_of_first = describe_share(rows, names[0], measure)
    if len(names) == 1:
        return f"of the laws {arm_rows.title(names[0])} settles most: {share_of_first}"
    words = listed(map(arm_rows.title, names)) if len(names) <= FEW else f"{len(names)} laws"
    return f"{words} are not distinguished from the best of them, {arm_rows.title(names[0])}: {share_of_first}"
