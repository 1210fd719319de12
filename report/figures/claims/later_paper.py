"""The claims of Lopez and Slotine 2024: a row for each claim, what decided it, and what we read of the paper."""

from collections.abc import Sequence
from typing import Any

from bench.experiments.tables.run import Run
from bench.findings import claims
from bench.findings.claims import Verdict
from bench.findings.claims.lopez_slotine_2024 import WHAT_WE_READ
from bench.findings.claims.lopez_slotine_2024.attitude import KEPT_DEG
from report.figures.claims import evidence
from report.figures.kit import html
from report.figures.kit.spelling import prose, typeset

PAPER = "lopez-slotine-2024"
VERDICTS = html.PageTable(
    "Claim | What the paper states, in our words | Verdict | What we measured"
)


def facts(run: Run) -> dict[str, Any]:
    """Return a row and a fold for each claim, their count, and the sentences on what we read."""
    verdicts = claims.judge_each(run, PAPER)
    return {
        "count": len(verdicts),
        "words": claims.format_tally(verdict.word for verdict in verdicts),
        "kept": f"{KEPT_DEG:.0f}",
        "read": typeset(" ".join(WHAT_WE_READ.split())),
        "verdicts": VERDICTS(map(describe, verdicts)),
        "sections": html.Html("".join(name_command(evidence.section(verdict, run)) for verdict in verdicts)),
        **find_numbers(verdicts),
    }


def name_command(section: str) -> str:
    """Return the fold of a claim with the command that judges the claims of this paper."""
    return section.replace("<code>bench claims</code>", f"<code>bench claims --paper {PAPER}</code>")


def find_numbers(verdicts: Sequence[Verdict]) -> dict[str, str]:
    """Return what was measured of the two claims that the text of the page is about; 'not tested' if not."""
    measured = {verdict.id: typeset(verdict.measured) for verdict in verdicts}
    return {"global": measured["LS06"], "paths": measured["LS03"]}


def describe(verdict: Verdict) -> tuple:
    """Return the row of a claim: its name and place, statement, verdict, and what was measured."""
    claim = verdict.claim
    return (
        f'<a href="#{claim.id.lower()}">{claim.id}</a> <span class="section">{claim.section}</span>',
        prose(claim.sentence),
        html.badge(str(verdict.word)),
        prose(verdict.measured),
    )
