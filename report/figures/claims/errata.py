"""What of the paper is corrected: by verdicts on its claims, and errata, each check run while the page is built."""

from __future__ import annotations

from bench.findings import claims
from bench.findings.claims.errata import ERRATA, Erratum
from report.figures.claims.claims import link
from report.figures.kit.page import Run
from report.figures.kit.spelling import prose
from report.figures.kit.tables import Table

CORRECTIONS = Table(" | Section | What the paper says, in our words | Correction")
SLIPS = Table(" | Where | Printed | Should be | Checked")
COMPUTED = [one for one in ERRATA if one.check is not None]
READ = [one for one in ERRATA if one.check is None]


class Unconfirmed(RuntimeError):
    """A check no longer confirms its erratum: the page must not say that it does."""


def checked(one: Erratum) -> str:
    """How it was checked, the computed ones just now.

    Errors:
        Unconfirmed: the check says no.
    """
    if one.check is None:
        return prose(one.how)
    if not one.check():
        raise Unconfirmed(
            f"erratum {one.id}: its check '{one.how}' does not confirm it (cure: mend bench/findings/claims/errata.py)"
        )
    return f"computed: {prose(one.how)}"


def row(one: Erratum) -> tuple:
    """Of the table."""
    return one.id, prose(one.where), f"“{prose(one.printed)}”", prose(one.right), checked(one)


def facts(_: Run) -> dict:
    """How many of each kind."""
    corrected = sum(bool(one.correction) for one in claims.judge_all())
    return {"n_computed": len(COMPUTED), "n_read": len(READ), "n_corrected": corrected}


def tables(_: Run) -> dict:
    """Corrections that verdicts make, and errata: the computed ones, and those found by reading."""
    corrected = CORRECTIONS(
        (link(one, "40-claims.html"), one.claim.section, prose(one.claim.sentence), prose(one.correction))
        for one in claims.judge_all()
        if one.correction
    )
    return {"corrected": corrected, "computed": SLIPS(map(row, COMPUTED)), "read": SLIPS(map(row, READ))}
