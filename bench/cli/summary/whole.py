"""The whole summary: the answer first, as soon as it is known, for the claims take seconds."""

from __future__ import annotations

import os
from pathlib import Path

from bench.cli.options import REFERENCE
from bench.cli.origin import origin
from bench.cli.paragraphs import Paragraph, print_paragraphs
from bench.cli.progress import progress
from bench.cli.screen import shown_path
from bench.cli.summary import absent, answer, failures, verdicts
from bench.experiments.tables import read as results
from bench.findings.claims import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.measured import measure


def print_summary(folder: Path, is_named: bool) -> None:
    """Print it. `is_named`: whether the user named the folder, so that the commands below name it too."""
    found = Results(folder)
    found.table("episodes")  # refuses a run that has not finished
    here = origin(folder)
    try:
        print_paragraphs(*answer.paragraphs(measure(found)))
    except NoEvidence:
        print_paragraphs(absent.undecided(found))
    with progress("claims", "judging the paper's claims"):
        judged = verdicts.paragraph(found)
    print_paragraphs(
        judged,
        failures.paragraph(found),
        *absent.paragraphs(found),
        Paragraph("This run", (here, *_instead(folder, is_named))),
        _next(folder, is_named, absent.parts_in(found)),
    )


def _instead(folder: Path, is_named: bool) -> list[str]:
    """Said where another folder stands in for results/latest."""
    stands_in = not is_named and folder == REFERENCE and results.VARIABLE not in os.environ
    return ["It came with the benchmark; results/latest has no finished run (try: make bench)."] * stands_in


def _next(folder: Path, is_named: bool, present: list[str]) -> Paragraph:
    here = shown_path(folder)
    show = f"python -m bench show {here}" if is_named else "python -m bench show"
    book = f"{results.VARIABLE}={here} make report" if is_named else "make report"
    parts = f", or one part: {', '.join(present)}" if len(present) > 1 else ""
    return Paragraph(
        "Next",
        (
            f"{book}   the book of this run",
            f"{show} --details   every table{parts}",
            f"python -m bench claims {here}   each claim with its evidence",
        ),
    )
