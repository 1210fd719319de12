"""Numbers, answers and verdicts in the sentences of the pages on compliance; words where a run does not hold them."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.findings import claims
from bench.tables import read
from report.figures.claims import claims as shown
from report.figures.contact import compliance_laws, compliance_rows, compliance_tables
from report.figures.kit import absent, html
from report.figures.kit.spelling import power

NEAR_ZERO_DEG = 15.0


def probed(rows: pd.DataFrame) -> dict[str, str]:
    """Of the probe.

    Args:
        rows: of wrench-probe.
    """
    if rows.empty:
        names = ("axes_arm", "probe_arms", "probe_rows", "gap", "cartesian", "zyz", "forms")
        return dict.fromkeys((*names, "work_n", "work_eps", "lost_axis", "lost_kept"), absent.WORDS)
    gap = max(compliance_laws.gaps(rows).values())
    return {
        **compliance_tables.facts(rows),
        "axes_arm": compliance_rows.arms(rows)[0],
        "probe_arms": " and ".join(compliance_rows.arms(rows)),
        "probe_rows": html.number(len(rows)),
        "gap": f"{power(gap)} of the value (up to {compliance_laws.COMPARED_TO:g}°)",
        "cartesian": cartesian(rows),
        "zyz": zyz(rows),
        "forms": forms(rows),
    }


def cartesian(rows: pd.DataFrame) -> str:
    """What Cartesian compliance leaves of the same errors, over every frame and order."""
    own = rows[rows["way"].isin(("hybrid-base", "hybrid-hand"))]
    done = int((own["outcome"] == "done").sum())
    return (
        f"Cartesian compliance, along the base's axes or the hand's, has none of it: {done} rows of {len(own)} reach "
        f"the end, and it leaks at most {power(own['leakage_ratio'].max())} and turns at most "
        f"{power(np.degrees(own['misalignment_rad'].max()))} degrees away from the moment. Poles of angles that it "
        "never computes do nothing to it."
    )


def zyz(rows: pd.DataFrame) -> str:
    """What Z-Y-Z angles make of compliance about x near zero."""
    own = compliance_rows.level(compliance_rows.of(rows, compliance_rows.ZYZ, "about x"))
    near = own[own["beta_deg"].abs() <= NEAR_ZERO_DEG]
    if near.empty:
        return f"Rows of Z-Y-Z angles are {absent.WORDS}."
    full = near["arm"].map({arm: compliance_rows.wanted(rows, arm) for arm in compliance_rows.arms(rows)}).astype(float)
    share = 100.0 * near["c_xx"] / full
    around = share[near["beta_deg"] != 0.0]
    said = (
        f"within {NEAR_ZERO_DEG:g} degrees of zero a moment about x turns the hand about x by {power(around.min())} to "
        f"{power(around.max())} % of what it should."
    )
    ends = {str(arm): how_it_ends(own, share[own.index]) for arm, own in near[near["beta_deg"] == 0.0].groupby("arm")}
    if not ends:
        return said
    return f"{said} At zero itself, on their singularity, rounding decides: {'; '.join(map(': '.join, ends.items()))}."


def how_it_ends(own: pd.DataFrame, share: pd.Series) -> str:
    """One row's outcome, or how far the hand turned, in words."""
    outcome = own["outcome"].iloc[0]
    return f"{power(share.iloc[0])} %" if outcome == "done" else outcome


def forms(rows: pd.DataFrame) -> str:
    """Whether the two ways to the joints differ where nothing is touched."""
    keys = ["arm", "way", "pose"]
    pair = rows[rows["form"] == "inverse"].merge(rows[rows["form"] == "projected"], on=keys)
    pair = pair[(pair["outcome_x"] == "done") & (pair["outcome_y"] == "done")]
    if pair.empty:
        return f"Rows of both ways are {absent.WORDS}."
    names = [f"c_{i}{j}" for i in "xyz" for j in "xyz"]
    one, other = (pair[[f"{name}_{side}" for name in names]].to_numpy() for side in "xy")
    apart = np.linalg.norm(one - other, axis=1) / np.linalg.norm(one, axis=1)
    return f"Over {len(pair)} pairs of rows that differ in nothing else, C is the same to {power(apart.max())}."


def verdicts(*ids: str) -> html.Markdown | None:
    """These claims with their words, linked to their sections."""
    run = claims.Results(read.folder())
    return shown.table([claims.judge(one, run) for one in ids], "40-claims.html")
