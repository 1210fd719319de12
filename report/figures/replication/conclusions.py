"""The paper's eight conclusions as rows, and how many of its statements hold."""

from collections.abc import Iterable, Iterator
from typing import Any

from bench.experiments.tables.run import Run
from bench.findings import claims
from bench.findings.claims import judge_possible
from bench.findings.claims.verdict import Verdict
from bench.findings.conclusions import Conclusion, conclude
from report.figures.kit import html
from report.figures.kit.law_names import call_laws
from report.figures.kit.spelling import prose

SHORT = html.PageTable("Murphy (1988) concluded | Our verdict | What we measured | Figure")
FULL = html.PageTable("Murphy's words | Claims | Our verdict | What we measured | Figure")

FIGURES = {
    "three-laws": "fig-three-laws",
    "responses": "fig-murphy-2-5",
    "cost": "fig-cost-time",
    "pole": "fig-pole-loop",
    "compliance": "fig-compliance-axes",
    "answer": "fig-half-turn-noise",
}
"""Subject of a conclusion -> label of the figure that shows it."""

SUBJECTS = {
    "rotation-matrix": "Rotation matrix",
    "linearized-euler": "Linearized Euler angles",
    "feedback-linearized": "Feedback linearization",
    "cost": "Cost",
    "no-regulator": "Cost and performance",
    "euler-jacobian": "Euler Jacobian",
    "compliance": "Compliance",
    "open-question": "Open question",
}
"""Name of a conclusion -> what it is about."""

EVIDENCE = "appendix-claims.html"


def facts(run: Run) -> dict[str, Any]:
    """Return how many statements hold, by the present criteria and by the first ones, and a row a conclusion."""
    return {**count_statements(run), "conclusions": FULL(list_in_full(run))}


def count_statements(run: Run) -> dict[str, Any]:
    """Count the statements of the paper by verdict, and the criteria that were revised."""
    decided, lacks = judge_possible(run)
    revised = [verdict for verdict in decided if verdict.claim.earlier]
    turned = [verdict for verdict in revised if verdict.word != verdict.first]
    return {
        "decided": len(decided) + len(lacks),
        "words": describe_verdicts(decided, lacks),
        "first_words": claims.format_tally(verdict.first for verdict in decided),
        "changed": len(revised),
        "turned": len(turned),
    }


def describe_verdicts(decided: list[Verdict], lacks: dict[str, str]) -> str:
    """Say how many statements have each verdict, and how many this run cannot decide."""
    counted = [claims.format_tally(verdict.word for verdict in decided)] if decided else []
    if lacks:
        counted.append(f"this run does not test {len(lacks)} statements")
    return ", ".join(counted)


def list_in_full(run: Run) -> Iterator[tuple]:
    """Return a row a conclusion: the paper's words, its claims, the verdict, one number and a figure."""
    for conclusion in conclude(run):
        words = f"**{SUBJECTS[conclusion.name]}.** “{prose(conclusion.quote)}” ({conclusion.section})"
        verdict = html.badge(conclusion.verdict)
        finding = prose(call_laws(conclusion.finding))
        yield words, link_claims(conclusion.claims), verdict, finding, refer(conclusion)


def list_in_short(run: Run) -> Iterator[tuple]:
    """Return the same in few words, for the front page."""
    for conclusion in conclude(run):
        words = f"**{SUBJECTS[conclusion.name]}:** “{prose(conclusion.short)}” ({conclusion.section})"
        verdict = html.badge(conclusion.verdict)
        yield words, verdict, prose(call_laws(conclusion.finding)), refer(conclusion)


def link_claims(ids: Iterable[str]) -> str:
    """Return the claims, each with a link to its evidence."""
    return ", ".join(f'<a href="{EVIDENCE}#{claim.lower()}">{claim}</a>' for claim in ids)


def refer(conclusion: Conclusion) -> str:
    """Return the number of the figure of a conclusion, as a link."""
    return f"{{numref}}`{FIGURES[conclusion.subject]}`"
