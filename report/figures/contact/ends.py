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
    parts = [f"at β = {beta:.0f}° {timed(mine)}" for beta, mine in of(own, PAPERS_EULER).groupby("beta_deg")]
    return (
        f"Tools lie flat once 2 % of the tilt is left: with Cartesian compliance {timed(of(own, PAPERS))}; on the "
        f"Euler Jacobian {'; '.join(parts)}."
    )


def timed(mine: pd.DataFrame) -> str:
    """How many tools come to lie flat, and the median time, in which a tool that never does takes for ever."""
    times = mine["time_to_align_s"].fillna(np.inf)
    is_flat = np.isfinite(times)
    if not np.isfinite(times.median()):
        return f"{is_flat.sum()} of {len(times)}, so that the median tool never does"
    slowest = times[is_flat].max()
    return f"{is_flat.sum()} of {len(times)}, the median in {times.median():.1f} s and the slowest in {slowest:.1f} s"


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
    return f"No controller limits the impact. The largest force is, in the median, {'; '.join(parts)}."


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
