"""What failed in a run, part by part. Settled a of b: of b episodes a settled; in contact, done a of b poses."""

from collections.abc import Iterator

import pandas as pd

from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.experiments.suites import IDEAL_MOTORS, NOMINAL
from bench.experiments.tables.run import Run

WORST = 2
"""Laws that are named of those that crashed or hung."""

LOST = ("crashed", "hung")


def paragraph(run: Run) -> Paragraph:
    """Return a line or two for each part that the run has."""
    episodes, contact, robustness = (
        run.table(name) for name in ("episodes", "compliance", "robustness")
    )
    on_arm, plant = episodes["arm"] != "", episodes["variation"].astype(str)
    is_other = ~plant.isin((NOMINAL, IDEAL_MOTORS))
    parts = {
        "Free body": (episodes[~on_arm], "law"),
        "Arms": (episodes[on_arm & (plant == NOMINAL)], "controller"),
        "Arms with ideal motors": (
            episodes[on_arm & (plant == IDEAL_MOTORS)],
            "controller",
        ),
        "Arms with other motors or model errors": (
            episodes[on_arm & is_other],
            "controller",
        ),
        "Contact": (contact, "controller"),
        "Robustness": (robustness, "law"),
    }
    said = [
        describe(part, rows, who) for part, (rows, who) in parts.items() if len(rows)
    ]
    return Paragraph(
        "What failed",
        (*said, *describe_broken(episodes, robustness))
        or ("There are no episodes in this run.",),
    )


def describe(part: str, rows: pd.DataFrame, who: str) -> str:
    """Say how many of a part's rows ended well, how many laws or controllers failed somewhere, and what got stuck."""
    good, what = ("done", "poses") if part == "Contact" else ("settled", "episodes")
    is_good = rows["outcome"] == good
    is_whole = is_good.groupby(rows["contender"].astype(str)).all()
    said = f"{part}: {good} {is_good.sum():,} of {len(rows):,} {what}."
    if len(is_whole) > 1 and not is_whole.all():
        said += (
            f" {(~is_whole).sum()} of {counted(len(is_whole), who)} failed somewhere."
        )
    if part == "Free body":
        stuck, apart = (
            rows[rows["outcome"] == "stuck"],
            int((rows["converged"] == "no").sum()),
        )
        at = int((stuck["start_set"] == "half-turn").sum())
        said += (
            f" {counted(len(stuck), 'episode')} got stuck, {at:,} of them at or near 180°."
            if len(stuck)
            else ""
        )
        said += f" {apart:,} did not converge." if apart else ""
    return said


def describe_broken(*tables: pd.DataFrame) -> Iterator[str]:
    """Yield which laws crashed or hung, and in how many episodes; nothing if none did."""
    every = [
        table.loc[table["outcome"].isin(LOST), ["contender", "outcome"]]
        for table in tables
        if len(table)
    ]
    rows = pd.concat(every).astype(str) if every else pd.DataFrame()
    if len(rows):
        by = [rows["contender"].str.partition("@")[0], "outcome"]
        counts = rows.groupby(by).size().sort_values(ascending=False)
        named = [
            f"{law} {word} in {counted(n, 'episode')}"
            for (law, word), n in counts.items()
        ][:WORST]
        more = [f"{len(counts) - WORST} more"] if len(counts) > WORST else []
        yield f"Broken laws: {listed(named + more)} (why: provenance.json, `lost`)."
