"""The page on the audit of an orientation error: its faults and forms, as they are registered."""

from __future__ import annotations

from bench.audit.faults import every_fault
from bench.audit.faults.digits_near_0 import COUNT_RAD
from bench.audit.forms import FORMS
from bench.audit.pairs import NEAR_IDENTITY, every_pair
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table

FAULTS = Table("Fault | What it is | What it does | Cure | Law")
FORM_TABLE = Table("Form | Along the axis")


def facts(_: Run) -> dict:
    """Numbers that the text takes."""
    pairs = every_pair()
    return {
        "faults": len(every_fault()),
        "pairs": len(pairs.angle),
        "smallest": power(pairs.angle[pairs.place == NEAR_IDENTITY].min()),
        "count": power(COUNT_RAD),
    }


def tables(_: Run) -> dict:
    """Return a row a fault, with the anchor that reports link to; a row a form."""
    return {
        "tab_faults": FAULTS(
            (anchored(one.name), one.title, one.effect, one.cure, html.law(one.law)) for one in every_fault()
        ),
        "tab_forms": FORM_TABLE((f"`{name}`", one.title) for name, one in FORMS.items()),
    }


def anchored(name: str) -> str:
    """Return a fault's name as code, with its anchor."""
    return f'<span id="{name}"></span>`{name}`'
