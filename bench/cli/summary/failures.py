"""What failed in a run, part by part. Settled a of b: of b episodes a settled; in contact, done a of b poses."""

from __future__ import annotations

import pandas as pd

from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.experiments.suites import NOMINAL
from bench.findings.claims import Results

WORST = 2
"""Laws that are named of those that crashed or hung."""

LOST = ("crashed", "hung")
HALF_TURNS = "half-turn"


def paragraph(results: Results) -> Paragraph:
    """Return a line or two for each part that the run has."""
    episodes, contact, robustness = (results.table(name) for name in ("episodes", "compliance", "robustness"))
    is_free = episodes["arm"] == ""
    said = [
        *_free_body(episodes[is_free]),
        *_arms(episodes[~is_free]),
        *_contact(contact),
        *([f"Robustness: settled {of(robustness)} episodes."] if len(robustness) else []),
        *_lost(episodes, robustness),
    ]
    return Paragraph("What failed", tuple(said) or ("There are no episodes in this run.",))


def of(rows: pd.DataFrame, good: str = "settled") -> str:
    """Count those that are good: a of b."""
    return f"{(rows['outcome'] == good).sum():,} of {len(rows):,}"


def failing(rows: pd.DataFrame, word: str, good: str = "settled") -> str:
    """Say how many laws or controllers have failures."""
    is_whole = (rows["outcome"] == good).groupby(rows["contender"].astype(str)).all()
    some = f" {(~is_whole).sum()} of {counted(len(is_whole), word)} failed somewhere."
    return some if len(is_whole) > 1 and not is_whole.all() else ""


def _free_body(rows: pd.DataFrame) -> list[str]:
    if rows.empty:
        return []
    stuck = rows[rows["outcome"] == "stuck"]
    at = int((stuck["start_set"] == HALF_TURNS).sum())
    dead = f" {counted(len(stuck), 'episode')} got stuck, {at:,} of them at or near 180°." if len(stuck) else ""
    apart = int((rows["converged"] == "no").sum())
    unsure = f" {apart:,} did not converge." if apart else ""
    return [f"Free body: settled {of(rows)} episodes.{failing(rows, 'law')}{dead}{unsure}"]


def _arms(every: pd.DataFrame) -> list[str]:
    is_nominal = every["variation"] == NOMINAL
    rows, varied = every[is_nominal], every[~is_nominal]
    arms = [f"{of(own)} on {arm}" for arm, own in rows.groupby("arm", observed=True, sort=False)]
    arms += [f"{of(varied)} with model errors"] if len(varied) else []
    return [f"Arms: settled {listed(arms)}.{failing(rows, 'controller')}"] if arms else []


def _contact(rows: pd.DataFrame) -> list[str]:
    return [f"Contact: done {of(rows, 'done')} poses.{failing(rows, 'controller', 'done')}"] if len(rows) else []


def _lost(*tables: pd.DataFrame) -> list[str]:
    every = [table.loc[table["outcome"].isin(LOST), ["contender", "outcome"]] for table in tables if len(table)]
    rows = pd.concat(every).astype(str) if every else pd.DataFrame()
    if rows.empty:
        return []
    counts = rows.groupby([rows["contender"].str.partition("@")[0], "outcome"]).size().sort_values(ascending=False)
    named = [f"{law} {word} in {counted(n, 'episode')}" for (law, word), n in counts.items()][:WORST]
    more = [f"{len(counts) - WORST} more"] if len(counts) > WORST else []
    return [f"Broken laws: {listed(named + more)} (why: provenance.json, `lost`)."]
