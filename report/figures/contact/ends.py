"""How episodes in contact end, in words: at rest or creeping, how soon, how hard they struck, and what they gave."""

from __future__ import annotations

import numpy as np
import pandas as pd

from report.figures.contact.rows import EULER, PAPERS, PAPERS_EULER, of
from report.figures.kit.page import ABSENT
from report.figures.kit.spelling import power
from tasks.contact_rest import HORIZON_S, REST

PRESSING = ("surface-alignment", "peg-in-hole", "force-on-plane")
"""Tasks in which a force is ordered."""


def ends(rows: pd.DataFrame) -> dict[str, str]:
    """The sentences of the page on tasks in contact."""
    return {
        "rest_rule": f"{1e3 * REST.speed:g} mm/s and {REST.rate:g} rad/s for {REST.hold_s:g} s",
        "rest_horizon": f"{HORIZON_S:g}",
        "rest": rested(rows),
        "align": aligned(rows),
        "overshoot": overshot(rows),
        "port": given_away(rows),
    }


def rested(rows: pd.DataFrame) -> str:
    """How many are at rest, and how fast the others creep; by the paper's force control."""
    own = rows[rows["contender"].isin((PAPERS, PAPERS_EULER)) & (rows["rest"].astype(str) != "")]
    if own.empty:
        return f"How episodes end is {ABSENT}."
    late = own[own["rest"].astype(str) == "creeping"]
    speed, rate = 1e3 * late["remaining_speed_m_per_s"], np.degrees(late["remaining_rate_rad_per_s"])
    words = f"{len(own) - len(late)} of {len(own)} are at rest."
    if late.empty:
        return words
    return (
        f"{words} The others creep at {power(speed.median())} mm/s and {power(rate.median())} °/s in the median, at "
        f"most {power(speed.max())} mm/s and {power(rate.max())} °/s."
    )


def aligned(rows: pd.DataFrame) -> str:
    """How long tools take to lie flat, by both Jacobians and the frame of the hand."""
    own = rows[rows["task"] == "surface-alignment"]
    if of(own, PAPERS).empty or of(own, PAPERS_EULER).empty:
        return f"How soon tools lie flat is {ABSENT}."
    cartesian = of(own, PAPERS)["time_to_align_s"]
    parts = []
    for beta, mine in of(own, PAPERS_EULER).groupby("beta_deg"):
        times = mine["time_to_align_s"].dropna()
        lasts = f", in {times.median():.1f} s in the median and {times.max():.1f} s at most" if len(times) else ""
        parts.append(f"at β = {beta:.0f}° {len(times)} of {len(mine)}{lasts}")
    return (
        f"With Cartesian compliance {cartesian.notna().sum()} of {len(cartesian)} tools come to lie flat (2 % of the "
        f"tilt left), in {cartesian.median():.1f} s in the median and {cartesian.max():.1f} s at most; on the Euler "
        f"Jacobian {'; '.join(parts)}."
    )


def overshot(rows: pd.DataFrame) -> str:
    """The force at the worst over the force ordered, by the paper's force control and by accelerations."""
    own = rows[rows["task"].isin(PRESSING) & (rows["outcome"] == "done")]
    own = own[own["contender"].isin((PAPERS, "hybrid-base+inverse"))]
    if own.empty:
        return f"How hard they strike is {ABSENT}."
    parts = []
    for task in (name for name in PRESSING if name in set(of(own, PAPERS)["task"])):
        mine = own[own["task"] == task]
        peaks = [of(mine, name)["peak_force_n"].median() for name in (PAPERS, "hybrid-base+inverse")]
        over = of(mine, PAPERS)["force_overshoot"].median()
        parts.append(
            f"{task.replace('-', ' ')} {peaks[0]:.0f} N ({1.0 + over:.1f} times the order along it; by accelerations "
            f"{peaks[1]:.0f} N)"
        )
    return f"What strikes overshoots: the largest force is, in the median, {'; '.join(parts)}."


def given_away(rows: pd.DataFrame) -> str:
    """The most energy given through the port, on the crank, which orders no force."""
    own = rows[(rows["task"] == "crank") & (rows["outcome"] == "done")]
    if of(own, PAPERS).empty:
        return f"What goes through the port is {ABSENT}."
    most = {name: of(own, name)["port_energy_peak_j"] for name in (PAPERS, PAPERS_EULER, EULER)}
    return (
        f"To turn the crank takes {most[PAPERS].median():.2f} J by the paper's force control along the base's axes "
        f"(median of {len(most[PAPERS])}); on the Euler Jacobian up to {power(most[PAPERS_EULER].max())} J, by "
        f"accelerations up to {power(most[EULER].max())} J."
    )
