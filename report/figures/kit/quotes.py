"""The paper's own words, as the texts of its claims have them."""

from bench.findings.claims import all_claims
from report.figures.kit.spelling import prose


def quote(claim_id: str) -> str:
    """Return the sentence of the paper that a claim is about, with its section."""
    [claim] = [one for one in all_claims() if one.id == claim_id]
    return f"“{prose(claim.quote)}” ({claim.section})"
