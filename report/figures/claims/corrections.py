"""The errata of the paper as a table, each check run while the page is built."""

from __future__ import annotations

import pandas as pd

from bench.findings.claims.errata import ERRATA, Erratum
from report.figures.kit import html
from report.figures.kit.spelling import prose


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


def table(computed: bool) -> html.Markdown:
    """The computed ones, or those found by reading."""
    rows = [
        {
            "": one.id,
            "Where": prose(one.where),
            "Printed": f"“{prose(one.printed)}”",
            "Should be": prose(one.right),
            "Checked": checked(one),
        }
        for one in ERRATA
        if (one.check is not None) == computed
    ]
    return html.table(pd.DataFrame(rows))


def count(computed: bool) -> int:
    """How many of either kind."""
    return sum((one.check is not None) == computed for one in ERRATA)
