"""What failed in a run, part by part. Settled a of b: of b episodes a settled; in contact, done a of b poses."""

from __future__ import annotations

import pandas as pd

from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.contenders.registry import known_regulators
from bench.experiments.suites import NOMINAL
from bench.findings.claims import Results
from bench.findings.perturbed import by_level, thresholds
from bench.findings.theory.thresholds import HALF_TURN
from bench.tables.read import with_contender

WORST = 2
"""Laws that are named, those that settle the smallest share; of controllers, whose names are long, one."""

LOST = ("crashed", "hung")
HALF_TURNS = "half-turn"


def paragraph(results: Results) -> Paragraph:
    """A line or two for each part that the run has."""
    episodes, contact, robustness = (results.table(name) for name in ("episodes", "compliance", "robustness"))
    is_free = episodes["arm"] == ""
    said = [
        *_free_body(episodes[is_free]),
        *_arms(episodes[~is_free]),
        *_contact(contact),
        *_robustness(robustness),
        *_lost(episodes, robustness),
    ]
    return Paragraph("What failed", tuple(said) or ("There are no episodes in this run.",))


def of(rows: pd.DataFrame, good: str = "settled") -> str:
    """Settled a of b."""
    return f"{good} {(rows['outcome'] == good).sum():,} of {len(rows):,}"


def worst(rows: pd.DataFrame, word: str, good: str = "settled", most: int = WORST) -> str:
    """How many laws or controllers have failures, and which settle the smallest share."""
    shares = (rows["outcome"] == good).groupby(rows["contender"].astype(str), sort=False).mean()
    failing = shares[shares < 1.0].sort_values(kind="stable")
    if failing.empty or len(shares) == 1:
        return ""
    named = [f"{name} ({of(rows[rows['contender'] == name], good)})" for name in failing.index[:most]]
    return f" {len(failing)} of {counted(len(shares), word)} failed at some starts, most often {listed(named)}."


def _free_body(rows: pd.DataFrame) -> list[str]:
    if rows.empty:
        return []
    stuck = rows[rows["outcome"] == "stuck"]
    at = int((stuck["start_set"] == HALF_TURNS).sum())
    of_them = f"{counted(len(stuck), 'episode')} of {counted(stuck['contender'].nunique(), 'law')}"
    dead = f" {of_them} ended at a dead point, {at:,} of them at or near a 180° rotation."
    dead = dead if len(stuck) else ""
    apart = int((rows["converged"] == "no").sum())
    unsure = f" {counted(apart, 'episode')} did not converge: their end depends on the step." if apart else ""
    return [f"Free body: {of(rows)} episodes.{worst(rows, 'law')}{dead}{unsure}"]


def _arms(every: pd.DataFrame) -> list[str]:
    said = []
    is_nominal = every["variation"] == NOMINAL
    rows, varied = every[is_nominal], every[~is_nominal]
    if len(rows):
        arms = [f"{of(own)} on {arm}" for arm, own in rows.groupby("arm", observed=True, sort=False)]
        causes = rows["cause"].astype(str).value_counts()
        near = ", ".join(f"{NEAR[one]} {causes[one]:,}" for one in NEAR if one in causes)
        failures = f" Failures near: {near}." if near else ""
        said.append(f"Arms: {listed(arms)}.{worst(rows, 'controller', most=1)}{failures}")
    if len(varied):
        said.append(f"Arms with model errors: {of(varied)} episodes.")
    return said


NEAR = {
    "kinematic": "kinematic singularity",
    "representation": "singularity of the representation",
    "both": "both",
    "torque": "torque limit",
    "law": "none of these",
}
"""Causes, as a sentence has them."""


def _contact(rows: pd.DataFrame) -> list[str]:
    return [f"Contact: {of(rows, 'done')} poses.{worst(rows, 'controller', 'done', 1)}"] if len(rows) else []


def _robustness(rows: pd.DataFrame) -> list[str]:
    """State the range of thresholds of every perturbation that does not do the same to all laws."""
    if rows.empty:
        return []
    found = thresholds(with_contender(by_level(with_contender(rows))))
    meant = {law: own for law, own in found.items() if not is_control(law)} or found
    parts, alike = [], 0
    for way in dict.fromkeys(way for own in meant.values() for way in own):
        by_text: dict[str, list[str]] = {}
        for law, own in meant.items():
            by_text.setdefault(str(own[way]), []).append(law)
        alike += len(by_text) == 1
        if len(by_text) > 1 and way.axis == HALF_TURN:
            best = max(by_text, key=lambda text: float(text.rstrip("+").replace("none", "-1")))
            end = ", the last level tried" if best.endswith("+") else ""
            parts = [f"Worst-case noise at 180°: {listed(by_text[best])} up to {best.rstrip('+')} rad{end}."]
    same = f" {alike} of the perturbations do the same to all laws." if alike else ""
    return [f"Robustness: {of(rows)} episodes. {' '.join(parts)}{same} Thresholds: show robustness.".replace("  ", " ")]


def is_control(law: str) -> bool:
    """Whether it is a negative control of ours."""
    one = known_regulators().get(law.partition("/")[0])
    return one is not None and one.control


def _lost(*tables: pd.DataFrame) -> list[str]:
    every = [table.loc[table["outcome"].isin(LOST), ["contender", "outcome"]] for table in tables if len(table)]
    rows = pd.concat(every).astype(str) if every else pd.DataFrame()
    if rows.empty:
        return ["No law crashed or hung."]
    counts = rows.groupby([rows["contender"].str.partition("@")[0], "outcome"]).size().sort_values(ascending=False)
    named = [f"{law} {word} in {counted(n, 'episode')}" for (law, word), n in counts.items()][:WORST]
    more = [f"{len(counts) - WORST} more"] if len(counts) > WORST else []
    return [f"Broken laws: {listed(named + more)} (why: provenance.json, `lost`)."]
