"""Slips of the paper, each check run while the page is built."""

from __future__ import annotations

from bench.findings.claims.errata import ERRATA, Erratum
from report.figures.kit.page import Run
from report.figures.kit.spelling import prose
from report.figures.kit.tables import Table

SLIPS = Table(" | Where | Printed | Should be | Checked")
COMPUTED = [one for one in ERRATA if one.check is not None]
READ = [one for one in ERRATA if one.check is None]


def checked(one: Erratum) -> str:
    """Return how it was checked, the computed ones just now.

    Errors:
        ValueError: the check no longer confirms its erratum, and the page must not say that it does.
    """
    if one.check and not one.check():
        raise ValueError(f"erratum {one.id}: its check '{one.how}' does not confirm it (cure: mend it in errata.py)")
    return f"{'computed: ' if one.check else ''}{prose(one.how)}"


def row(one: Erratum) -> tuple:
    """Return a row of the table."""
    return one.id, prose(one.where), f"“{prose(one.printed)}”", prose(one.right), checked(one)


def facts(_: Run) -> dict:
    """How many of each kind."""
    return {"n_computed": len(COMPUTED), "n_read": len(READ)}


def tables(_: Run) -> dict:
    """Return the computed slips, then those found by reading."""
    return {"slips": SLIPS(map(row, (*COMPUTED, *READ)))}
