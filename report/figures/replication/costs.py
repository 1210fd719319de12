"""What the paper said of cost, as rows: its words, the verdict, and what was counted and measured."""

from collections.abc import Iterator
from typing import Any

from bench.experiments.tables.run import Run
from bench.findings.claims import judge_possible
from report.figures.kit import html
from report.figures.kit.quotes import quote
from report.figures.kit.spelling import prose
from report.figures.replication.conclusions import call_laws, link_claims

COSTS = html.PageTable("Claim | Murphy's words | Our verdict | What we measured")

CLAIMS = ("C12", "C26", "C33", "C17")
"""Claims on cost: the order of the laws, the Euler Jacobian, its force control, and cost beside performance."""


def facts(run: Run) -> dict[str, Any]:
    """Return a row a claim on cost."""
    return {"table": COSTS(list_claims(run))}


def list_claims(run: Run) -> Iterator[tuple]:
    """Return the rows; a claim that this run does not decide is not tested."""
    decided, _ = judge_possible(run)
    verdicts = {verdict.id: verdict for verdict in decided}
    for claim in CLAIMS:
        verdict = verdicts.get(claim)
        word = str(verdict.word) if verdict else html.UNTESTED
        measured = prose(call_laws(verdict.measured)) if verdict else html.UNTESTED
        yield link_claims([claim]), quote(claim), html.badge(word), measured
