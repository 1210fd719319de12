"""The page on checking an error and exporting a law: faults, forms and languages, as they are registered."""

from typing import Any

from bench.audit.convention import FORMS
from bench.audit.examined import COUNT_RAD
from bench.audit.faults import every_fault
from bench.audit.pairs import every_pair
from bench.experiments.tables.run import Run
from bench.export.language import find_language, language_words
from bench.export.subject import subject_words
from bench.export.vectors import CLOSE
from bench.findings.amounts import join_words
from report.figures.kit import html
from report.figures.kit.spelling import power

FAULTS = html.PageTable(
    "Fault | Description | Effect on the controller | Cure | Law without the fault"
)


def facts(_: Run) -> dict[str, Any]:
    """Return the numbers and names in the text, and a row a fault."""
    pairs = every_pair()
    return {
        "languages": join_words([find_language(word).title for word in language_words()]),
        "words": join_words([f"`{word}`" for word in language_words()]),
        "close": f"{CLOSE:g}",
        "subjects": len(subject_words()),
        "faults": len(every_fault()),
        "forms": join_words([f"{one.title} (`{name}`)" for name, one in FORMS.items()]),
        "pairs": len(pairs.angle),
        "smallest": power(pairs.angle[pairs.at("near-identity")].min()),
        "count": power(COUNT_RAD),
        "tab_faults": FAULTS(
            (f"`{one.name}`", one.title, one.effect, one.cure, html.law(one.law)) for one in every_fault()
        ),
    }
